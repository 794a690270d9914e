#include "firmware/tools/bench/can/twist_trial.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "config/rates.hpp"
#include "drivers/drive_fault_text.hpp"
#include "firmware/motion/kinematics.hpp"
#include "firmware/safety/command_gate.hpp"
#include "firmware/safety/guarded_bus.hpp"

namespace ivo::firmware::bench {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;
using drivers::GroupState;

constexpr Twist kSane{.vx_mps = 0.3, .vy_mps = 0.0, .wz_radps = 0.0};
constexpr Duration kDriving = 1s;
constexpr Duration kWrong = 500ms;

Twist twist_of(WrongCommand wrong) {
  const double value = wrong == WrongCommand::kNotANumber ? std::numeric_limits<double>::quiet_NaN()
                       : wrong == WrongCommand::kInfinite ? std::numeric_limits<double>::infinity()
                                                          : 1e9;
  return {.vx_mps = value, .vy_mps = 0.0, .wz_radps = 0.0};
}

/// The drives of a rig, driven without a loop.
class Doors {
 public:
  explicit Doors(FaultRig& rig)
      : rig_(rig),
        kinematics_(rig.robot().base),
        gate_(rig.robot().limits, rates::kFeedbackTimeout),
        guarded_(rig.tap(), rig.robot()),
        group_(guarded_, rig.robot()) {
    rig_.drives().open();
    group_.open(rig_.now());
  }

  /// One cycle with this command; `gated` is false for one that goes past the first door.
  void cycle(const Twist& twist, bool enable, bool gated = true) {
    rig_.tap().clear();
    std::array<hal::ReceivedFrame, limits::kFramesPerCycle> frames;
    const std::size_t count = guarded_.receive(frames, rig_.now());
    for (std::size_t i = 0; i < count; ++i) {
      group_.on_frame(frames[i]);
    }
    feedback_ = group_.update(rig_.now());
    const CommandGate::Verdict verdict = gate_.judge({.may_move = enable,
                                                      .drives_enabled = feedback_.state == GroupState::kEnabled,
                                                      .feedback_age = Duration::zero(),
                                                      .pose = {},
                                                      .command = twist});
    refusal_ = verdict.refusal;
    guarded_.permit_motion(enable);
    group_.write(rig_.now(), enable, {kinematics_.wheel_speeds(gated ? verdict.command : twist)});
    rig_.pass_period();
  }
  bool run_until(GroupState state, bool enable) {
    for (int i = 0; i < 5000 && feedback_.state != state; ++i) {
      cycle({}, enable);
    }
    return feedback_.state == state;
  }

  [[nodiscard]] const drivers::GroupFeedback& feedback() const noexcept { return feedback_; }
  [[nodiscard]] Refusal refusal() const noexcept { return refusal_; }
  void clear() noexcept { group_.reset_fault(); }

 private:
  FaultRig& rig_;
  Kinematics kinematics_;
  CommandGate gate_;
  GuardedBus guarded_;
  drivers::DriveGroup group_;
  drivers::GroupFeedback feedback_;
  Refusal refusal_ = Refusal::kNone;
};

/// Frames of the last cycle with a target.
int targets_in(FaultRig& rig) {
  return static_cast<int>(std::count_if(rig.sent().begin(), rig.sent().end(), [](const hal::CanFrame& frame) {
    const bool command = frame.id > 0x200 && frame.id < 0x280;
    return command && std::any_of(frame.data.begin() + 2, frame.data.end(), [](std::uint8_t b) { return b != 0; });
  }));
}

void be_wrong(WrongCommand wrong, Doors& doors, FaultRig& rig, FaultFigures& figures) {
  const Instant begin = rig.now();
  const bool gated = wrong != WrongCommand::kHugePastTheGate;
  int cycles_since_found = 0;
  while (rig.now() - begin < kWrong) {
    const double since_ms = seconds(rig.now() - begin) * 1e3;
    doors.cycle(twist_of(wrong), true, gated);
    const bool found = gated ? doors.refusal() != Refusal::kNone : doors.feedback().state == GroupState::kFault;
    if (found && !figures.detected_ms) {
      figures.detected_ms = since_ms;
      figures.says = gated ? std::string(name_of(doors.refusal())) : drivers::describe(doors.feedback().fault);
    }
    const int targets = targets_in(rig);
    if (figures.detected_ms) {
      ++cycles_since_found;
      figures.told_cycles = targets > 0 ? cycles_since_found : figures.told_cycles.value_or(0);
    }
    if (!figures.rest_ms && rig.at_rest()) {
      figures.rest_ms = since_ms;
    }
    figures.unasked += figures.rest_ms ? targets : 0;
  }
}

}  // namespace

Result<FaultFigures> try_command(WrongCommand wrong) {
  Result<std::unique_ptr<FaultRig>> made = FaultRig::make({});
  if (!made) {
    return made.error();
  }
  FaultRig& rig = *made.value();
  Doors doors(rig);
  if (!doors.run_until(GroupState::kReady, false) || !doors.run_until(GroupState::kEnabled, true)) {
    return Error{"the drives did not come up: " + drivers::describe(doors.feedback().fault)};
  }
  for (const Instant end = rig.now() + kDriving; rig.now() < end;) {
    doors.cycle(kSane, true);
  }
  FaultFigures figures;
  const double ramp_s = rig.rim_speed_mps() / rig.robot().limits.stop_decel_mps2;
  figures.rest_limit_ms = ramp_s * 1e3 + 4.0 * seconds(rates::kCycle) * 1e3;  // one to notice, then three to act
  be_wrong(wrong, doors, rig, figures);
  if (doors.feedback().state == GroupState::kFault) {
    doors.clear();
    (void)(doors.run_until(GroupState::kReady, false) && doors.run_until(GroupState::kEnabled, true));
  }
  for (const Instant end = rig.now() + kDriving; rig.now() < end;) {
    doors.cycle(kSane, true);
  }
  figures.moves_again = rig.rim_speed_mps() > 0.1;
  return figures;
}

}  // namespace ivo::firmware::bench
