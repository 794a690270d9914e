// A transmit queue that takes only some of what is sent: the wheels that we do not reach stop all the same.
#include <gtest/gtest.h>

#include "drivers/drive_fault_text.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;

long heartbeats(const Rig& rig, std::size_t from) {
  return std::count_if(rig.log.begin() + static_cast<std::ptrdiff_t>(from), rig.log.end(),
                       [](const hal::CanFrame& frame) { return frame.id == 0x77F; });
}

/// SYNC, then so many of the four commands as there is room for.
class FullQueue : public testing::TestWithParam<std::size_t> {};

TEST_P(FullQueue, IsAFaultOfAllFourAndStopsThem) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  const std::size_t before = rig.log.size();
  rig.narrow.room = GetParam();
  for (int i = 0; i < DriveGroup::kUnsentWrites; ++i) {
    ASSERT_EQ(rig.cycle().state, GroupState::kEnabled) << i;
  }
  EXPECT_EQ(rig.cycle().state, GroupState::kFault);
  EXPECT_EQ(rig.feedback.fault.reason, DriveFaultReason::kCommandsNotSent);
  EXPECT_EQ(
      describe(rig.feedback.fault),
      "commands do not get out: no other node acknowledges them, the transmit queue is full, or the interface is down");
  rig.run(rates::kMasterHeartbeatTimeout + milliseconds(400));
  EXPECT_EQ(heartbeats(rig, before), 0);
  EXPECT_FALSE(any_enabled(rig));
  EXPECT_TRUE(all_at_rest(rig));
  EXPECT_FALSE(rig.feedback.off) << "the off word did not get out";
}

INSTANTIATE_TEST_SUITE_P(WithRoomForSome, FullQueue, testing::Values(0U, 1U, 2U, 4U));

TEST(DriveGroupBus, ForgivesFewerUntakenWritesAndSendsTheHeartbeatAfterThem) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  for (int round = 0; round < 30; ++round) {
    rig.narrow.room = 4;
    for (int i = 1; i < DriveGroup::kUnsentWrites; ++i) {
      ASSERT_EQ(rig.cycle().state, GroupState::kEnabled);
    }
    rig.narrow.room = 1000;
    const std::size_t before = rig.log.size();
    ASSERT_EQ(rig.cycle().state, GroupState::kEnabled);
    EXPECT_EQ(heartbeats(rig, before), 0) << "not in the write after one that was not taken whole";
    rig.run(rates::kMasterHeartbeat + rates::kCycle);  // so that a heartbeat is once due in every place
    EXPECT_GE(heartbeats(rig, before), 1);
  }
}

TEST(DriveGroupBus, AFullQueueThatOnlyLosesTheHeartbeatStopsTheDrives) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.narrow.room = 5;
  rig.run(rates::kMasterHeartbeatTimeout + milliseconds(100));
  EXPECT_EQ(rig.feedback.state, GroupState::kFault);
  EXPECT_FALSE(any_enabled(rig));
}

TEST(DriveGroupBus, AFrameOfOursThatTheBusRefusesStopsAllFourAtOnceAndIsSaidSo) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.narrow.refused += 4;
  EXPECT_EQ(rig.cycle().state, GroupState::kFault);
  EXPECT_EQ(describe(rig.feedback.fault),
            "the last door before the bus refused what this controller was to send (4 of its frames): a fault of the "
            "program");
  expect_stopped_command(rig);
  rig.run(milliseconds(500));
  EXPECT_TRUE(all_at_rest(rig));
  rig.enable = false;
  rig.group.reset_fault();
  EXPECT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
}

TEST(DriveGroupBus, MovesAgainAfterANewStartUpWhenTheQueueIsFree) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.narrow.room = 2;
  ASSERT_TRUE(rig.run_until(GroupState::kFault));
  rig.narrow.room = 1000;
  rig.enable = false;
  rig.group.reset_fault();
  ASSERT_TRUE(rig.run_until(GroupState::kBooting));
  ASSERT_TRUE(rig.run_until(GroupState::kReady)) << describe(rig.feedback.fault);
  rig.enable = true;
  EXPECT_TRUE(rig.run_until(GroupState::kEnabled));
}

}  // namespace
}  // namespace ivo::drivers
