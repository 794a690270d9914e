// Faults of a drive, of the bus and of the master: all four stop, and nothing moves again by itself.
#include <gtest/gtest.h>

#include "drivers/canopen/emcy.hpp"
#include "drivers/drive_fault_text.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;
using std::chrono::milliseconds;

// Faults of one drive while all four turn. Each latches for all, in the same cycle, and nothing moves again by itself.

struct FaultCase {
  const char* name;
  void (*provoke)(Rig&);
  DriveFaultReason reason;
  Duration within;  // from provoking to the stop on the bus
};

void provoke_with(Rig& rig, const hal::CanFrame& frame) { rig.inject(frame); }

const FaultCase kFaults[] = {
    {"DriveFault", [](Rig& rig) { rig.drives.drive(Wheel::kRearLeft).script().fault_at = rig.clock.now(); },
     DriveFaultReason::kEmergency, milliseconds(6)},
    {"Reboot", [](Rig& rig) { rig.drives.drive(Wheel::kRearLeft).script().reboot_at = rig.clock.now(); },
     DriveFaultReason::kRebooted, milliseconds(6)},
    {"Silence", [](Rig& rig) { rig.drives.drive(Wheel::kRearLeft).script().silent_from = Instant{}; },
     DriveFaultReason::kFeedbackLost, milliseconds(16)},
    {"LostFeedback", [](Rig& rig) { rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{}; },
     DriveFaultReason::kFeedbackLost, milliseconds(16)},
    {"LostHeartbeat", [](Rig& rig) { rig.drives.drive(Wheel::kRearLeft).script().heartbeat_lost_from = Instant{}; },
     DriveFaultReason::kHeartbeatLost, milliseconds(156)},
    {"Emergency",
     [](Rig& rig) {
       provoke_with(rig, emergency_frame(3, {0x4210, 0x09}));
     },
     DriveFaultReason::kEmergency, milliseconds(6)},
    {"ShortEmergency",
     [](Rig& rig) {
       provoke_with(rig, {.id = 0x083, .size = 2, .data = {0, 0}});
     },
     DriveFaultReason::kEmergency, milliseconds(6)},
    {"FaultStatusWithoutEmergency",
     [](Rig& rig) {
       rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
       provoke_with(rig, {.id = 0x183, .size = 6, .data = {0x18, 0x02}});
     },
     DriveFaultReason::kDriveInFault, milliseconds(6)},
    {"LeftOperationEnabled",
     [](Rig& rig) {
       rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
       provoke_with(rig, {.id = 0x183, .size = 6, .data = {0x50, 0x02}});
     },
     DriveFaultReason::kLeftOperationEnabled, milliseconds(6)},
    {"ShortFeedback",
     [](Rig& rig) {
       rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
       for (int i = 0; i < 20; ++i) {
         provoke_with(rig, {.id = 0x183, .size = 5, .data = {0x37, 0x02}});
       }
     },
     DriveFaultReason::kFeedbackLost, milliseconds(16)},
};

class DriveGroupFault : public testing::TestWithParam<FaultCase> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rig_.drive_at(5.0));
    provoked_ = rig_.clock.now();
    GetParam().provoke(rig_);
    ASSERT_TRUE(rig_.run_until(GroupState::kFault));
  }
  Rig rig_;
  Instant provoked_{};
};

TEST_P(DriveGroupFault, StopsAllFourInTheSameCycleAndNamesTheDrive) {
  EXPECT_EQ(rig_.feedback.fault.reason, GetParam().reason) << describe(rig_.feedback.fault);
  EXPECT_EQ(rig_.feedback.fault.node_id, 3);
  EXPECT_EQ(describe(rig_.feedback.fault).substr(0, 19), "drive 3 (rear left)");
  EXPECT_LE(rig_.clock.now() - provoked_, GetParam().within);
  expect_stopped_command(rig_);
}

TEST_P(DriveGroupFault, BringsTheOthersToRestAndKeepsThemThere) {
  for (int i = 0; i < 2500; ++i) {
    rig_.cycle();
    expect_stopped_command(rig_);
  }
  EXPECT_EQ(rig_.feedback.state, GroupState::kFault);
  for (const Wheel wheel : {Wheel::kFrontLeft, Wheel::kFrontRight, Wheel::kRearRight}) {
    EXPECT_TRUE(rig_.drives.drive(wheel).motion().at_rest());
    EXPECT_EQ(rig_.drives.drive(wheel).power_state(), PowerState::kSwitchOnDisabled);
  }
}

TEST_P(DriveGroupFault, MovesAgainOnlyAfterResetAndANewEnable) {
  SimScript& script = rig_.drives.drive(Wheel::kRearLeft).script();
  script.silent_from = script.feedback_lost_from = script.heartbeat_lost_from = SimScript::kNever;
  rig_.group.reset_fault();
  ASSERT_TRUE(rig_.run_until(GroupState::kReady)) << describe(rig_.feedback.fault);
  EXPECT_EQ(rig_.feedback.fault.reason, DriveFaultReason::kNone);
  rig_.run(milliseconds(200));
  EXPECT_EQ(rig_.feedback.state, GroupState::kReady) << "enable was true all the time";
  rig_.enable = false;
  rig_.cycle();
  rig_.enable = true;
  EXPECT_TRUE(rig_.run_until(GroupState::kEnabled)) << describe(rig_.feedback.fault);
}

INSTANTIATE_TEST_SUITE_P(OfOneDrive, DriveGroupFault, testing::ValuesIn(kFaults),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(DriveGroup, AResetWaitsForTheQuickStop) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(10.0));
  rig.inject(emergency_frame(3, {0x4210, 0x09}));
  ASSERT_TRUE(rig.run_until(GroupState::kFault));
  rig.group.reset_fault();
  rig.cycle();
  ASSERT_FALSE(all_at_rest(rig));
  EXPECT_EQ(controlword_of(rig.last_command(1)), 0x02);
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  EXPECT_TRUE(all_at_rest(rig));
}

TEST(DriveGroup, ADriveThatStaysInFaultFailsTheReset) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
  const hal::CanFrame stuck{.id = 0x183, .size = 6, .data = {0x18, 0x02}};
  for (int i = 0; i < 2000; ++i) {
    rig.inject(stuck);
    rig.cycle();
    if (i == 100) {
      EXPECT_EQ(rig.feedback.fault.reason, DriveFaultReason::kDriveInFault);
      rig.group.reset_fault();
    }
  }
  EXPECT_EQ(rig.feedback.state, GroupState::kFault);
  EXPECT_EQ(describe(rig.feedback.fault), "drive 3 (rear left): fault could not be reset (statusword 0218h)");
}

TEST(DriveGroup, ADriveThatDoesNotPowerUpInTimeStopsTheEnabling) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
  rig.enable = true;
  const hal::CanFrame torque_off{.id = 0x183, .size = 6, .data = {0x40, 0x02}};
  for (int i = 0; i < 600; ++i) {
    rig.inject(torque_off);
    rig.cycle();
  }
  EXPECT_EQ(describe(rig.feedback.fault),
            "drive 3 (rear left): does not take power: is its STO or the emergency stop open? (statusword 0240h)");
  EXPECT_FALSE(any_enabled(rig));
}

TEST(DriveGroup, AWheelThatDoesNotComeToRestIsNamedAndLosesItsPower) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(1.0));
  rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
  rig.group.stop(rig.clock.now());
  for (int i = 0; i < 1700; ++i) {
    hal::CanFrame runaway{.id = 0x183, .size = 6, .data = {0x17, 0x02}};
    store(std::span(runaway.data).subspan(2), static_cast<std::uint32_t>(100 * i));
    rig.inject(runaway);
    rig.cycle();
  }
  EXPECT_EQ(describe(rig.feedback.fault), "drive 3 (rear left): wheel not at rest in time after a stop");
  EXPECT_EQ(controlword_of(rig.last_command(3)), 0x00);
}

TEST(DriveGroup, ADriveThatAQuickStopDoesNotSlowDownIsNamedOnceItHadItsTime) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  (void)rig.drives.drive(Wheel::kRearLeft).script().events.push_back({.fault = SimFault::kEndlessStop, .on = true});
  rig.group.fail({.reason = DriveFaultReason::kStopInput, .code = 2}, rig.clock.now());
  rig.run(rates::kStandstillTimeout - milliseconds(10));
  EXPECT_EQ(describe(rig.feedback.fault), "bumper 2 touched");
  EXPECT_FALSE(all_at_rest(rig));
  rig.run(milliseconds(14));
  EXPECT_EQ(describe(rig.feedback.fault),
            "bumper 2 touched; drive 3 (rear left) still turned when the quick stop had had its time");
  rig.run(milliseconds(1000));
  EXPECT_TRUE(all_at_rest(rig)) << "without voltage it coasts";
  rig.enable = false;
  rig.group.reset_fault();
  ASSERT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  EXPECT_EQ(describe(rig.feedback.fault), "no fault");
}

class PushedAfter : public testing::TestWithParam<int> {};

TEST_P(PushedAfter, AWheelThatStoppedInTimeIsNotNamed) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.group.fail({.reason = DriveFaultReason::kStopInput, .code = 2}, rig.clock.now());
  rig.run(milliseconds(GetParam()));
  ASSERT_TRUE(rig.feedback.standstill);
  rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
  for (int i = 0; i < 2000; ++i) {
    hal::CanFrame pushed{.id = 0x183, .size = 6, .data = {0x50, 0x02}};
    store(std::span(pushed.data).subspan(2), static_cast<std::uint32_t>(100 * i));
    rig.inject(pushed);
    rig.cycle();
    EXPECT_FALSE(rig.feedback.standstill && i > 100);
  }
  EXPECT_EQ(describe(rig.feedback.fault), "bumper 2 touched");
}
INSTANTIATE_TEST_SUITE_P(Ms, PushedAfter, testing::Values(600, 2500, 3010));

TEST(DriveGroup, AResetThatFailsAfterTheQuickStopHadItsTimeNamesNoWheelThatIsRolled) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  (void)rig.drives.drive(Wheel::kFrontLeft).script().events.push_back({.fault = SimFault::kFaultAgain, .on = true});
  (void)rig.drives.drive(Wheel::kFrontLeft).script().events.push_back({.fault = SimFault::kFault, .on = true});
  rig.run(rates::kStandstillTimeout + milliseconds(500));
  rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = Instant{};
  rig.enable = false;
  rig.group.reset_fault();
  for (int i = 0; i < 2000; ++i) {
    hal::CanFrame rolled{.id = 0x183, .size = 6, .data = {0x50, 0x02}};
    store(std::span(rolled.data).subspan(2), static_cast<std::uint32_t>(100 * i));
    rig.inject(rolled);
    rig.cycle();
  }
  EXPECT_EQ(rig.feedback.state, GroupState::kFault);
  EXPECT_EQ(rig.feedback.fault.node_id, 1) << describe(rig.feedback.fault);
  EXPECT_EQ(rig.feedback.fault.turning_node_id, 0) << describe(rig.feedback.fault);
}

TEST(DriveGroup, DrivesStopByThemselvesWhenTheMasterFallsSilent) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  const Instant silent_since = rig.clock.now();
  while (any_enabled(rig)) {
    rig.clock.sleep_until(rig.clock.now() + rates::kCycle);
    rig.drives.update(rig.clock.now());
    ASSERT_LT(rig.clock.now() - silent_since, milliseconds(160));
  }
  rig.clock.sleep_until(rig.clock.now() + milliseconds(1000));
  rig.drives.update(rig.clock.now());
  EXPECT_TRUE(all_at_rest(rig));
}

TEST(DriveGroup, StopsWhenTheBusGoesAway) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.bus.set_state(0, hal::BusState::kOff);
  EXPECT_TRUE(rig.run_until(GroupState::kFault));
  EXPECT_EQ(describe(rig.feedback.fault), "bus lost: bus-off");
  rig.run(milliseconds(500));
  EXPECT_FALSE(any_enabled(rig)) << "the drives miss our heartbeat";
  EXPECT_FALSE(rig.feedback.off) << "nobody can say so";
}

}  // namespace
}  // namespace ivo::drivers
