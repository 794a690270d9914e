// What the group sees on the bus beyond the drives' own words: another master, lost frames, twins, irregular feedback.
#include <gtest/gtest.h>

#include "drivers/canopen/heartbeat.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/drive_fault_text.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class DriveGroupWatch : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rig_.drive_at(5.0)); }
  /// One cycle; the fault that it found.
  DriveFaultReason next() {
    rig_.cycle();
    return rig_.feedback.fault.reason;
  }
  /// Clears what is latched and drives again.
  void recover() {
    rig_.run(seconds(1));
    rig_.group.reset_fault();
    ASSERT_TRUE(rig_.run_until(GroupState::kReady)) << describe(rig_.feedback.fault);
    rig_.run(milliseconds(100));
    ASSERT_FALSE(any_enabled(rig_)) << "enable was true all the time";
    rig_.enable = false;
    rig_.cycle();
    rig_.enable = true;
    ASSERT_TRUE(rig_.run_until(GroupState::kEnabled));
    rig_.run(milliseconds(300));
  }
  Rig rig_;
};

class ForeignMaster : public DriveGroupWatch, public testing::WithParamInterface<std::uint16_t> {};

TEST_P(ForeignMaster, StopsAllFourInTheSameCycle) {
  rig_.inject({.id = GetParam(), .size = 0, .data = {}});
  EXPECT_EQ(next(), DriveFaultReason::kForeignMaster);
  EXPECT_EQ(rig_.feedback.fault.code, GetParam());
  EXPECT_EQ(rig_.feedback.fault.node_id, 0);
  expect_stopped_command(rig_);
  rig_.run(seconds(1));
  EXPECT_TRUE(all_at_rest(rig_));
  recover();
}
INSTANTIATE_TEST_SUITE_P(NmtSyncHeartbeatSdoAndRpdos, ForeignMaster,
                         testing::Values(0x000, 0x080, 0x77F, 0x601, 0x604, 0x202, 0x303, 0x401, 0x504));

TEST_F(DriveGroupWatch, ForgivesFramesOfOthersThatAreNotOurs) {
  for (const std::uint16_t id :
       std::initializer_list<std::uint16_t>{0x001, 0x100, 0x205, 0x605, 0x705, 0x77E, 0x7E5, 0x585}) {
    rig_.inject({.id = id, .size = 8, .data = {}});
    EXPECT_EQ(next(), DriveFaultReason::kNone) << std::hex << id;
  }
}

TEST_F(DriveGroupWatch, AForeignMasterIsSeenDuringStartUpToo) {
  Rig rig;
  rig.run(milliseconds(4));
  rig.inject(nmt_frame({NmtCommand::kStart, 0}));
  rig.cycle();
  EXPECT_EQ(describe(rig.feedback.fault),
            "another master on the bus sent COB-ID 000h; expected none but this controller");
}

TEST_F(DriveGroupWatch, LostFramesStopAllFour) {
  const hal::CanFrame nobodys{.id = 0x7E5, .size = 0, .data = {}};
  for (std::size_t i = 0; i <= hal::VirtualBus::kQueueFrames; ++i) {
    rig_.inject(nobodys);
  }
  EXPECT_EQ(next(), DriveFaultReason::kFramesLost);
  EXPECT_GE(rig_.feedback.fault.code, 1U);
  rig_.run(milliseconds(40));  // the listener's own queue was as long
  expect_stopped_command(rig_);
  recover();
}

TEST_F(DriveGroupWatch, AFloodIsNamed) {
  for (int cycle = 0; cycle < BusWatch::kFloodCycles && rig_.feedback.state == GroupState::kEnabled; ++cycle) {
    for (std::size_t i = 0; i < BusWatch::kFloodFrames + 1; ++i) {
      rig_.inject({.id = 0x7E5, .size = 0, .data = {}});
    }
    rig_.cycle();
  }
  EXPECT_EQ(rig_.feedback.fault.reason, DriveFaultReason::kBusFlooded);
  expect_stopped_command(rig_);
}

TEST_F(DriveGroupWatch, AnErrorPassiveControllerStopsAllFour) {
  rig_.bus.set_state(0, hal::BusState::kPassive);
  EXPECT_EQ(next(), DriveFaultReason::kBusLost);
  EXPECT_EQ(describe(rig_.feedback.fault), "bus lost: error passive");
  expect_stopped_command(rig_);
}

TEST(DriveGroup, StartsUpWithAnErrorPassiveController) {
  Rig rig;
  rig.bus.set_state(0, hal::BusState::kPassive);
  rig.run(milliseconds(20));
  rig.bus.set_state(0, hal::BusState::kActive);
  EXPECT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
}

TEST_F(DriveGroupWatch, ABusThatWasOffComesBackOnlyByReset) {
  rig_.bus.set_state(0, hal::BusState::kOff);
  EXPECT_EQ(next(), DriveFaultReason::kBusLost);
  rig_.run(seconds(1));
  EXPECT_TRUE(all_at_rest(rig_)) << "the drives miss our heartbeat";
  rig_.bus.set_state(0, hal::BusState::kActive);
  rig_.run(seconds(2));
  EXPECT_EQ(rig_.feedback.state, GroupState::kFault);
  expect_stopped_command(rig_);
  recover();
}

TEST_F(DriveGroupWatch, FeedbackThatComesTwiceTooOftenStopsAllFour) {
  for (int i = 0; i < 30 && rig_.feedback.state == GroupState::kEnabled; ++i) {
    hal::CanFrame copy{.id = 0x183, .size = 6, .data = {0x37, 0x12}};
    store(std::span(copy.data).subspan(2),
          static_cast<std::uint32_t>(rig_.drives.drive(Wheel::kRearLeft).motion().position()));
    rig_.inject(copy);
    rig_.cycle();
  }
  EXPECT_EQ(describe(rig_.feedback.fault),
            "drive 3 (rear left): feedback comes missing or double too often (21 of 100)");
  expect_stopped_command(rig_);
}

TEST_F(DriveGroupWatch, TwoDevicesOnOneNodeIdAreTold) {
  for (int i = 0; i < 250 && rig_.feedback.state == GroupState::kEnabled; ++i) {
    if (i % 25 == 12) {  // every 50 ms, in between the drive's own
      rig_.inject(heartbeat_frame(3, NmtState::kOperational));
    }
    rig_.cycle();
  }
  EXPECT_EQ(describe(rig_.feedback.fault),
            "drive 3 (rear left): two devices answer to this node-id; expected one each");
  expect_stopped_command(rig_);
}

TEST_F(DriveGroupWatch, AFaultFoundElsewhereStopsAllFourWithTheNextWrite) {
  rig_.cycle();
  rig_.group.fail({.reason = DriveFaultReason::kStopInput, .code = 2}, rig_.clock.now());
  rig_.group.write(rig_.clock.now(), true, rig_.targets);
  rig_.cycle();
  EXPECT_EQ(describe(rig_.feedback.fault), "bumper 2 touched");
  expect_stopped_command(rig_);
  rig_.group.fail({.reason = DriveFaultReason::kCycleLate, .code = 9}, rig_.clock.now());
  EXPECT_EQ(next(), DriveFaultReason::kStopInput) << "the first one stays";
  recover();
}

TEST_F(DriveGroupWatch, AWheelsFaultFoundElsewhereNamesTheDrive) {
  rig_.group.fail({.reason = DriveFaultReason::kEncoderStuck, .wheel = Wheel::kFrontRight}, rig_.clock.now());
  EXPECT_EQ(describe(rig_.group.update(rig_.clock.now()).fault),
            "drive 2 (front right): told to turn, but its position stays: encoder, coupling or a blocked wheel");
}

TEST_F(DriveGroupWatch, ADriveThatMissesSyncIsToldToLeaveOperational) {
  rig_.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = rig_.clock.now();
  ASSERT_TRUE(rig_.run_until(GroupState::kFault));
  rig_.run(milliseconds(4));
  EXPECT_EQ(rig_.drives.drive(Wheel::kRearLeft).nmt_state(), NmtState::kPreOperational);
  EXPECT_EQ(rig_.drives.drive(Wheel::kFrontLeft).nmt_state(), NmtState::kOperational) << "it answers";
  rig_.run(seconds(1));
  EXPECT_TRUE(all_at_rest(rig_));
}

// Drives that do not watch their RPDO (1400h:5): nothing but our heartbeat tells them that we are there.
SimDrives::Scripts without_deadline() {
  SimDrives::Scripts scripts;
  for (SimScript& script : scripts) {
    script.stuck = SimScript::Stuck{.object = {0x1400, 5}, .value = 0, .code = {}};
  }
  return scripts;
}

TEST(DriveGroup, ADriveThatTurnsForADeadMasterIsNotKeptGoingByOurHeartbeat) {
  Rig rig(without_deadline());
  ASSERT_TRUE(rig.drive_at(5.0));
  DriveGroup successor(rig.bus.port(4), rig.robot);
  successor.open(rig.clock.now());
  rig.bus.lose(0x000, 100);  // nobody hears the new master's NMT reset
  for (int i = 0; i < 100; ++i) {
    successor.update(rig.clock.now());
    successor.write(rig.clock.now(), false, {});
    rig.clock.sleep_until(rig.clock.now() + rates::kCycle);
    rig.drives.update(rig.clock.now());
  }
  EXPECT_FALSE(any_enabled(rig));
}

TEST(DriveGroup, DrivesStopByOurMissingHeartbeatAlone) {
  Rig rig(without_deadline());
  ASSERT_TRUE(rig.drive_at(5.0));
  const Instant silent_since = rig.clock.now();
  while (any_enabled(rig)) {
    rig.clock.sleep_until(rig.clock.now() + rates::kCycle);
    rig.drives.update(rig.clock.now());
    ASSERT_LE(rig.clock.now() - silent_since, rates::kMasterHeartbeatTimeout + 2 * rates::kCycle);
  }
}

TEST(DriveGroup, ASecondDriveThatMissesSyncAfterAnotherFaultLeavesOperationalToo) {
  Rig rig(without_deadline());
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.group.fail({.reason = DriveFaultReason::kStopInput}, rig.clock.now());
  rig.drives.drive(Wheel::kRearLeft).script().feedback_lost_from = rig.clock.now();
  rig.run(milliseconds(100));
  EXPECT_EQ(rig.drives.drive(Wheel::kRearLeft).nmt_state(), NmtState::kPreOperational);
}

TEST(DriveGroup, ADriveThatDoesNotObeyIsTakenOutOfOperationalAndLosesOurHeartbeat) {
  Rig rig(without_deadline());
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.bus.lose(0x203, 1'000'000);
  rig.group.fail({.reason = DriveFaultReason::kStopInput}, rig.clock.now());
  rig.run(milliseconds(3900));
  EXPECT_EQ(rig.drives.drive(Wheel::kRearLeft).power_state(), cia402::PowerState::kOperationEnabled);
  rig.run(milliseconds(1500));
  EXPECT_TRUE(all_at_rest(rig));
  EXPECT_FALSE(any_enabled(rig));
  rig.log.clear();
  rig.run(seconds(1));
  EXPECT_TRUE(std::ranges::none_of(rig.log, [](const hal::CanFrame& frame) { return frame.id == 0x77F; }));
}

TEST(DriveGroup, ADriveThatStaysInQuickStopActiveIsPoweredOff) {
  SimDrives::Scripts scripts;
  scripts[2].stuck = SimScript::Stuck{.object = {0x605A, 0}, .value = 6, .code = {}};
  Rig rig(scripts);
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.enable = false;  // in motion: a quick stop
  ASSERT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  EXPECT_LT(rig.clock.now().time_since_epoch(), seconds(10));
  rig.run(seconds(1));
  EXPECT_EQ(rig.feedback.state, GroupState::kReady);
}

TEST_F(DriveGroupWatch, DrivesThatMissedOurHeartbeatAreStartedUpAnew) {
  for (int i = 0; i < 100; ++i) {  // we hang for 200 ms
    rig_.clock.sleep_until(rig_.clock.now() + rates::kCycle);
    rig_.drives.update(rig_.clock.now());
  }
  rig_.run(seconds(1));
  ASSERT_EQ(rig_.feedback.state, GroupState::kFault);
  recover();
}

TEST_F(DriveGroupWatch, FaultsThatComeBackEndTheResets) {
  const auto trip = [&] {
    rig_.group.fail({.reason = DriveFaultReason::kWheelSlip, .code = 80}, rig_.clock.now());
    rig_.group.write(rig_.clock.now(), true, {});
  };
  for (int i = 0; i < rates::kResetLimit; ++i) {
    trip();
    recover();
  }
  trip();
  rig_.run(seconds(2));
  rig_.group.reset_fault();
  EXPECT_EQ(next(), DriveFaultReason::kResetLimit);
  rig_.run(seconds(5));
  EXPECT_EQ(describe(rig_.feedback.fault), "faults come back: 3 resets did not help; start anew when it is mended");
  EXPECT_FALSE(any_enabled(rig_));
  rig_.run(rates::kResetWindow);
  recover();
}

}  // namespace
}  // namespace ivo::drivers
