#include "firmware/safety/command_gate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "firmware/safety/mode.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""ns;

constexpr Duration kAgeLimit = 10ms;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

MotionLimits limits() {
  MotionLimits limits;
  limits.max_speed_mps = 0.5;
  limits.max_turn_radps = 1.0;
  return limits;
}

CommandGate::Input allowed() {
  return {
      .may_move = true, .drives_enabled = true, .feedback_age = 2ms, .pose = {1, 2, 3}, .command = {0.3, -0.2, 0.5}};
}

bool is_zero(const Twist& t) { return t.vx_mps == 0 && t.vy_mps == 0 && t.wz_radps == 0; }

Refusal refusal_of(const CommandGate::Input& input) {
  CommandGate gate(limits(), kAgeLimit);
  const CommandGate::Verdict verdict = gate.judge(input);
  EXPECT_TRUE(verdict.refusal == Refusal::kNone || is_zero(verdict.command)) << name_of(verdict.refusal);
  return verdict.refusal;
}

TEST(CommandGate, RefusesWhateverIsNotSaid) {
  CommandGate::Input silent;
  silent.command = {0.1, 0, 0};
  EXPECT_EQ(refusal_of(silent), Refusal::kModeForbids);
  silent.may_move = true;
  EXPECT_EQ(refusal_of(silent), Refusal::kDrivesNotEnabled);
  silent.drives_enabled = true;
  EXPECT_EQ(refusal_of(silent), Refusal::kFeedbackStale);
}

TEST(CommandGate, PassesAnAllowedCommandUnchanged) {
  CommandGate gate(limits(), kAgeLimit);
  const CommandGate::Verdict verdict = gate.judge(allowed());
  EXPECT_EQ(verdict.refusal, Refusal::kNone);
  EXPECT_EQ(verdict.command.vx_mps, 0.3);
  EXPECT_EQ(verdict.command.vy_mps, -0.2);
  EXPECT_EQ(verdict.command.wz_radps, 0.5);
}

TEST(CommandGate, PassesInNoModeAndConditionButTheRightOnes) {
  const std::array<Mode, kModes> modes{Mode::kPlanning, Mode::kStarting, Mode::kAwaitingConsent, Mode::kSearching,
                                       Mode::kStopping, Mode::kDone,     Mode::kFault,           Mode::kPausing};
  const std::vector<std::pair<Duration, bool>> ages{
      {0ms, true}, {kAgeLimit, true}, {kAgeLimit + 1ns, false}, {Duration::max(), false}, {-1ns, false}};
  const std::vector<std::pair<Pose, bool>> poses{
      {{0, 0, 0}, true}, {{kNan, 0, 0}, false}, {{0, kInf, 0}, false}, {{0, 0, kNan}, false}, {{0, 0, -kInf}, false}};
  const std::vector<std::pair<Twist, bool>> commands{
      {{0.5, 0, 1.0}, true},    {{-0.3, 0.4, -1.0}, true}, {{0, 0, 0}, true},       {{kNan, 0, 0}, false},
      {{0, -kInf, 0}, false},   {{0, 0, kNan}, false},     {{0.501, 0, 0}, false},  {{0.4, 0.4, 0}, false},
      {{0, -0.501, 0}, false},  {{0, 0, 1.001}, false},    {{0, 0, -1.001}, false}, {{1e308, 1e308, 0}, false},
      {{0.49, 0, 1e300}, false}};
  int passed = 0;
  for (const Mode mode : modes) {
    for (const bool enabled : {false, true}) {
      for (const auto& [age, fresh] : ages) {
        for (const auto& [pose, pose_good] : poses) {
          for (const auto& [command, command_good] : commands) {
            const bool may_move = permissions(mode).may_move;
            const Refusal refusal = refusal_of({may_move, enabled, age, pose, command});
            const bool in_motion = mode == Mode::kSearching || ramps_down(mode);
            const bool should = in_motion && enabled && fresh && pose_good && command_good;
            ASSERT_EQ(refusal == Refusal::kNone, should) << name_of(mode) << ": " << name_of(refusal);
            passed += should ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_EQ(passed, 3 * 2 * 1 * 3) << "three modes, two ages, one pose, three commands";
}

TEST(CommandGate, RefusesMotionWhileFeedbackIsStale) {
  CommandGate::Input input = allowed();
  input.feedback_age = kAgeLimit;
  EXPECT_EQ(refusal_of(input), Refusal::kNone);
  input.feedback_age = kAgeLimit + 1ns;
  EXPECT_EQ(refusal_of(input), Refusal::kFeedbackStale);
}

TEST(CommandGate, RefusesFeedbackFromTheFuture) {
  CommandGate::Input input = allowed();
  input.feedback_age = -1ns;
  EXPECT_EQ(refusal_of(input), Refusal::kFeedbackStale);
}

TEST(CommandGate, NamesTheCommandThatIsNotANumberAndThePoseThatIsNone) {
  CommandGate::Input input = allowed();
  input.command.vy_mps = kNan;
  EXPECT_EQ(refusal_of(input), Refusal::kCommandNotFinite);
  input.pose.heading_rad = kNan;
  EXPECT_EQ(refusal_of(input), Refusal::kPoseNotFinite);
}

TEST(CommandGate, RefusesBeyondALimitInsteadOfClamping) {
  CommandGate::Input input = allowed();
  input.command = {0.51, 0, 0};
  EXPECT_EQ(refusal_of(input), Refusal::kTooFast);
  input.command = {0, 0, -1.01};
  EXPECT_EQ(refusal_of(input), Refusal::kTurnsTooFast);
}

TEST(CommandGate, MeasuresSpeedAsAVector) {
  CommandGate::Input input = allowed();
  input.command = {0.3, 0.4, 0};
  EXPECT_EQ(refusal_of(input), Refusal::kNone);
  input.command = {0.4, 0.4, 0};
  EXPECT_EQ(refusal_of(input), Refusal::kTooFast);
}

TEST(CommandGate, AllowsForTheLastBitsOfACommandScaledToTheLimit) {
  CommandGate::Input input = allowed();
  input.command = {std::nextafter(0.5, 1.0), 0, std::nextafter(1.0, 2.0)};
  EXPECT_EQ(refusal_of(input), Refusal::kNone);
}

TEST(CommandGate, RefusesEverythingWhenItsOwnLimitsAreNotNumbers) {
  MotionLimits broken;
  broken.max_speed_mps = kNan;
  CommandGate gate(broken, kAgeLimit);
  EXPECT_EQ(gate.judge(allowed()).refusal, Refusal::kTooFast);
}

TEST(CommandGate, CountsRefusalsByReason) {
  CommandGate gate(limits(), kAgeLimit);
  CommandGate::Input fast = allowed();
  fast.command = {9, 0, 0};
  CommandGate::Input stale = allowed();
  stale.feedback_age = 20ms;
  (void)gate.judge(fast);
  (void)gate.judge(fast);
  (void)gate.judge(stale);
  (void)gate.judge(allowed());
  EXPECT_EQ(gate.refused(Refusal::kTooFast), 2U);
  EXPECT_EQ(gate.refused(Refusal::kFeedbackStale), 1U);
  EXPECT_EQ(gate.refused(Refusal::kModeForbids), 0U);
  EXPECT_EQ(gate.refused(Refusal::kNone), 0U);
}

TEST(CommandGate, JudgesButDoesNotCountACommandOfZero) {
  CommandGate gate(limits(), kAgeLimit);
  CommandGate::Input rest = allowed();
  rest.command = {};
  rest.may_move = false;
  EXPECT_EQ(gate.judge(rest).refusal, Refusal::kModeForbids);
  EXPECT_EQ(gate.refused(Refusal::kModeForbids), 0U);
  rest.command.wz_radps = kNan;
  EXPECT_EQ(gate.judge(rest).refusal, Refusal::kModeForbids);
  EXPECT_EQ(gate.refused(Refusal::kModeForbids), 1U);
}

TEST(CommandGate, NamesEveryReasonDifferently) {
  std::set<std::string_view> names;
  for (int i = 0; i < kRefusals; ++i) {
    names.insert(name_of(static_cast<Refusal>(i)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kRefusals));
}

}  // namespace
}  // namespace ivo::firmware
