// When the loop may end: what GroupFeedback::off says in each state, against what the drives really do.
#include <gtest/gtest.h>

#include "drivers/canopen/emcy.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;
using std::chrono::milliseconds;

bool all_really_off(Rig& rig) {
  return std::none_of(kAll.begin(), kAll.end(), [&](Wheel wheel) {
    const PowerState state = rig.drives.drive(wheel).power_state();
    return state == PowerState::kSwitchedOn || state == PowerState::kOperationEnabled ||
           state == PowerState::kQuickStopActive || state == PowerState::kFaultReactionActive;
  });
}

/// Cycles until off, at most 5 s; no cycle says off while a drive has power. Negative when it never came.
int cycles_until_off(Rig& rig) {
  for (int i = 0; i < 2500; ++i) {
    if (rig.cycle().off) {
      EXPECT_TRUE(all_really_off(rig)) << i;
      return i;
    }
  }
  return -1;
}

TEST(DrivesOff, IsSaidWhileBootingAndSoonAfterReady) {
  Rig rig;
  while (rig.cycle().state == GroupState::kBooting) {
    EXPECT_TRUE(rig.feedback.off);
  }
  ASSERT_EQ(rig.feedback.state, GroupState::kReady);
  const int cycles = cycles_until_off(rig);
  EXPECT_GE(cycles, 0);
  EXPECT_LE(cycles, 4);
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(rig.cycle().off);
  }
}

TEST(DrivesOff, IsNotSaidWhileAnythingHasPower) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.run(milliseconds(20));
  rig.enable = true;
  rig.targets.radps.fill(5.0);
  ASSERT_TRUE(rig.run_until(GroupState::kEnabling));
  EXPECT_FALSE(rig.feedback.off);
  ASSERT_TRUE(rig.run_until(GroupState::kEnabled));
  rig.run(milliseconds(200));
  EXPECT_FALSE(rig.feedback.off);
  rig.enable = false;
  ASSERT_TRUE(rig.run_until(GroupState::kStopping));
  EXPECT_FALSE(rig.feedback.off);
  EXPECT_GE(cycles_until_off(rig), 0);
  EXPECT_EQ(rig.feedback.state, GroupState::kReady);
}

TEST(DrivesOff, AfterAFaultWaitsForQuickStopAndTheOffWordToAct) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(10.0));
  rig.inject(emergency_frame(3, {0x4210, 0x09}));
  ASSERT_TRUE(rig.run_until(GroupState::kFault));
  EXPECT_FALSE(rig.feedback.off);
  EXPECT_GT(cycles_until_off(rig), 25) << "the dwell of the standstill alone";
  EXPECT_TRUE(all_at_rest(rig));
}

TEST(DrivesOff, AfterAFaultAtRestStillWaitsForTwoSyncs) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(0.0));
  ASSERT_TRUE(rig.feedback.standstill);
  rig.inject(emergency_frame(3, {0x4210, 0x09}));
  ASSERT_TRUE(rig.run_until(GroupState::kFault));
  EXPECT_FALSE(rig.feedback.off);
  rig.cycle();
  EXPECT_FALSE(rig.feedback.off) << "the off word was not answered yet";
  EXPECT_GE(cycles_until_off(rig), 0);
}

TEST(DrivesOff, ADriveInFaultIsOffAndASilentOneDoesNotBlock) {
  for (const bool silent : {false, true}) {
    Rig rig;
    ASSERT_TRUE(rig.drive_at(5.0));
    SimScript& script = rig.drives.drive(Wheel::kRearLeft).script();
    script.fault_at = silent ? SimScript::kNever : rig.clock.now();
    script.silent_from = silent ? Instant{} : SimScript::kNever;
    ASSERT_TRUE(rig.run_until(GroupState::kFault));
    EXPECT_FALSE(rig.feedback.off);
    EXPECT_GE(cycles_until_off(rig), 0) << silent;
  }
}

TEST(DrivesOff, ADriveThatKeepsItsPowerIsNeverOff) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(0.0));
  rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
  rig.group.stop(rig.clock.now());
  for (int i = 0; i < 3000; ++i) {
    rig.inject({.id = 0x183, .size = 6, .data = {0x37, 0x02}});
    EXPECT_FALSE(rig.cycle().off) << i;
  }
  EXPECT_EQ(rig.feedback.state, GroupState::kFault);
}

TEST(DrivesOff, IsSaidWhenNobodyAnswersAndNothingWasEverEnabled) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.run(milliseconds(20));
  rig.bus.set_state(0, hal::BusState::kOff);
  ASSERT_TRUE(rig.run_until(GroupState::kFault));
  rig.run(milliseconds(20));
  EXPECT_TRUE(rig.feedback.off);
}

}  // namespace
}  // namespace ivo::drivers
