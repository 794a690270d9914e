// The whole of a check, with a technician who sees what the simulated base really does.
#include <algorithm>
#include <string>

#include "firmware/tools/wheels/check_guide.hpp"
#include "firmware/tools/wheels/wheel_findings.hpp"
#include "tests/unit/firmware/tools/wheels/turner_rig.hpp"

namespace ivo::firmware::wheels {
namespace {

class Technician {
 public:
  Technician(const Robot& file, const Robot& base, const drivers::SimDrives::Scripts& scripts = {})
      : rig_(file, base, scripts), guide_(file, 1.0, 1.0) {
    EXPECT_TRUE(rig_.run_until(TurnPhase::kOff));
  }

  Findings check() {
    for (int step = 0; guide_.step() != CheckStep::kDone && step < 100; ++step) {
      switch (guide_.step()) {
        case CheckStep::kTurnALittle:
        case CheckStep::kTurnRound:
          turn();
          break;
        case CheckStep::kWhichWheel:
          guide_.which(moved_);
          break;
        case CheckStep::kForward:
          guide_.forward(turns_ > 0.0);
          break;
        case CheckStep::kHowManyTurns:
          guide_.how_many(std::round(std::abs(turns_) * 50.0) / 50.0);  // a person sees fiftieths at best
          break;
        case CheckStep::kDone:
          break;
      }
    }
    EXPECT_EQ(guide_.step(), CheckStep::kDone);
    EXPECT_FALSE(rig_.any_power());
    return findings_of(rig_.robot, guide_.observations());
  }

 private:
  void turn() {
    std::array<double, kWheels> before{};
    for (std::size_t i = 0; i < before.size(); ++i) {
      before[i] = rig_.turns(static_cast<Wheel>(i));
    }
    rig_.turner.give(guide_.order());
    const TurnStatus* status = nullptr;
    for (int tries = 0; tries < 30; ++tries) {
      rig_.run(400ms);
      rig_.hold(tries == 0 ? 15s : 3s);
      rig_.run(3s);
      status = &rig_.cycle();
      if (guide_.over(*status, false)) {
        break;
      }
    }
    ASSERT_TRUE(guide_.over(*status, false));
    (void)guide_.moved(*status);
    moved_.reset();
    turns_ = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double went = rig_.turns(static_cast<Wheel>(i)) - before[i];
      if (std::abs(went) > 0.005) {
        moved_ = static_cast<Wheel>(i);
        turns_ = went;
      }
    }
  }

  TurnerRig rig_;
  CheckGuide guide_;
  std::optional<Wheel> moved_;
  double turns_ = 0.0;
};

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += line + "\n";
  }
  return text;
}

TEST(WheelCheck, FindsNothingOnABaseThatIsAsTheFileSays) {
  const Findings found = Technician(geared_robot(), geared_robot()).check();
  EXPECT_TRUE(found.all_right) << text_of(found.lines);
  EXPECT_EQ(text_of(found.toml), "");
}

TEST(WheelCheck, FindsAWrongSign) {
  Robot base = geared_robot();
  base.drives[1].sign = 1;
  const Findings found = Technician(geared_robot(), base).check();
  EXPECT_FALSE(found.all_right);
  EXPECT_EQ(text_of(found.toml), "[drive.front_right]\nsign = 1  # was -1\n");
}

TEST(WheelCheck, FindsExchangedNodeIds) {
  Robot base = geared_robot();
  std::swap(base.drives[2].node_id, base.drives[3].node_id);
  const Findings found = Technician(geared_robot(), base).check();
  EXPECT_EQ(text_of(found.toml),
            "[drive.rear_left]\nnode_id = 4  # was 3\n\n[drive.rear_right]\nnode_id = 3  # was 4\n");
}

TEST(WheelCheck, FindsACycleOfNodeIdsWithSignsThatGoWithTheWheel) {
  Robot base = geared_robot();  // node 1 is front right, 2 rear left, 3 front left
  base.drives[1].node_id = 1;
  base.drives[2].node_id = 2;
  base.drives[0].node_id = 3;
  const Findings found = Technician(geared_robot(), base).check();
  EXPECT_EQ(text_of(found.toml),
            "[drive.front_left]\nnode_id = 3  # was 1\n\n[drive.front_right]\nnode_id = 1  # was 2\n\n"
            "[drive.rear_left]\nnode_id = 2  # was 3\n");
}

TEST(WheelCheck, FindsAWrongGear) {
  Robot file = geared_robot();
  Robot base = geared_robot();
  for (std::size_t i = 0; i < file.drives.size(); ++i) {
    file.drives[i].gear_ratio = 25.0;
  }
  const Findings found = Technician(file, base).check();
  EXPECT_NE(text_of(found.toml).find("[drive.rear_right]\ngear_ratio = 20  # was 25\n"), std::string::npos)
      << text_of(found.toml);
  EXPECT_EQ(found.toml.size(), 4U * 2U + 3U);
}

TEST(WheelCheck, FindsCountsThatAreFourfold) {
  Robot base = geared_robot();
  base.drives[0].counts_per_turn *= 4.0;
  const Findings found = Technician(geared_robot(), base).check();
  EXPECT_EQ(text_of(found.toml), "[drive.front_left]\ncounts_per_turn = 16384  # was 4096\n") << text_of(found.lines);
}

TEST(WheelCheck, AWheelThatMadeAPartOfATurnIsTurnedFurther) {
  Robot file = geared_robot();
  file.drives[0].gear_ratio = 7.0;  // 20 in truth
  const Findings found = Technician(file, geared_robot()).check();
  EXPECT_EQ(text_of(found.toml), "[drive.front_left]\ngear_ratio = 20  # was 7\n") << text_of(found.lines);
}

TEST(WheelCheck, FindsASpeedThatIsAFewPercentOff) {
  Robot base = geared_robot();
  base.drives[2].velocity_per_radps *= 1.05;
  const Findings found = Technician(geared_robot(), base).check();
  ASSERT_EQ(found.toml.size(), 2U);
  EXPECT_NEAR(std::stod(found.toml[1].substr(std::string("velocity_per_radps = ").size())), 651.8986469 * 1.05, 0.7);
  EXPECT_NE(text_of(found.lines).find("% slower than told"), std::string::npos) << text_of(found.lines);
}

TEST(WheelCheck, FindsRevolutionsAMinuteWhereTheFileHasCounts) {
  Robot base = geared_robot();
  base.drives[3].velocity_per_radps = 60.0 / (2.0 * std::numbers::pi);
  const Findings found = Technician(geared_robot(), base).check();
  ASSERT_EQ(found.toml.size(), 2U) << text_of(found.lines);
  EXPECT_NEAR(std::stod(found.toml[1].substr(std::string("velocity_per_radps = ").size())), 9.549, 0.1);
}

TEST(WheelCheck, NamesAWheelWhosePositionStays) {
  Robot base = geared_robot();
  base.drives[0].velocity_per_radps *= 1000.0;
  const Findings found = Technician(geared_robot(), base).check();
  EXPECT_FALSE(found.all_right);
  EXPECT_NE(text_of(found.lines).find("front left (node 1): nobody saw a wheel turn; its position hardly changes"),
            std::string::npos)
      << text_of(found.lines);
}

TEST(WheelFindings, TellNoNodeIdsFromAnswersThatContradictEachOther) {
  std::array<WheelObservation, kWheels> seen;
  for (WheelObservation& wheel : seen) {
    wheel = {
        .checked = true, .turned = Wheel::kFrontLeft, .turns_seen = 1.0, .turns_measured = 1.0, .speed_ratio = 1.0};
  }
  const Findings found = findings_of(geared_robot(), seen);
  EXPECT_FALSE(found.all_right);
  EXPECT_TRUE(found.toml.empty());
  EXPECT_NE(text_of(found.lines).find("check once more"), std::string::npos);
}

TEST(WheelFindings, AreNotAllRightBeforeEveryWheelWasChecked) {
  std::array<WheelObservation, kWheels> seen;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i] = {.checked = i < 3,
               .turned = static_cast<Wheel>(i),
               .turns_seen = 1.0,
               .turns_measured = 1.0,
               .speed_ratio = 1.0};
  }
  EXPECT_FALSE(findings_of(geared_robot(), seen).all_right);
  seen[3].checked = true;
  EXPECT_TRUE(findings_of(geared_robot(), seen).all_right);
}

TEST(WheelFindings, ForgiveWhatTheEyeCannotTell) {
  const DriveParameters drive = geared_robot().drives[0];
  const WheelObservation seen{
      .checked = true, .turned = Wheel::kFrontLeft, .turns_seen = 1.02, .turns_measured = 1.0, .speed_ratio = 1.0};
  EXPECT_EQ(correct(drive, seen).drive, drive);
}

TEST(WheelFindings, NumbersThatMakeNoSenseChangeNothing) {
  const DriveParameters drive = geared_robot().drives[0];
  for (const double odd : {0.0, -1.0, std::nan("")}) {
    WheelObservation seen{
        .checked = true, .turned = Wheel::kFrontLeft, .turns_seen = 0.5, .turns_measured = odd, .speed_ratio = 1.0};
    EXPECT_EQ(correct(drive, seen).drive, drive);
    seen.turns_measured = 1.0;
    seen.speed_ratio = odd;
    EXPECT_EQ(correct(drive, seen).drive, drive);
  }
}

}  // namespace
}  // namespace ivo::firmware::wheels
