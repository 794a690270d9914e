#include "drivers/sim/sim_drives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/sdo_abort.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/drive_fault_text.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;

/// One drive, node 1, asked by hand.
class SimDriveByHand : public testing::Test {
 protected:
  SimDriveByHand() { drive_.open(out_); }

  std::uint32_t ask(const SdoMessage& request) {
    out_.clear();
    drive_.on_frame(sdo_frame(0x601, request), out_);
    EXPECT_EQ(out_.size(), 1U);
    const SdoMessage answer = parse_sdo(out_[0]).value_or(SdoMessage{});
    EXPECT_EQ(answer.address, request.address);
    command_ = answer.command;
    return answer.data;
  }
  std::uint32_t write(ObjectAddress address, std::uint8_t bytes, std::uint32_t value) {
    return ask({sdo_command::expedited(0x20, bytes), address, value});
  }
  void expect_abort(std::uint32_t code, SdoAbort expected) {
    EXPECT_EQ(command_, 0x80);
    EXPECT_EQ(name_of(SdoAbort{code}), name_of(expected));
  }

  SimDrive drive_{test_robot().drives[0]};
  SimDrive::Outbox out_;
  std::uint8_t command_ = 0;
};

using SimDriveTest = SimDriveByHand;

TEST_F(SimDriveTest, SaysBootUpWhenPoweredAndWhenReset) {
  EXPECT_EQ(out_[0], (hal::CanFrame{.id = 0x701, .size = 1, .data = {0}}));
  for (const NmtCommand command : {NmtCommand::kResetNode, NmtCommand::kResetCommunication}) {
    out_.clear();
    drive_.on_frame(nmt_frame({command, 0}), out_);
    ASSERT_EQ(out_.size(), 1U);
    EXPECT_EQ(out_[0].data[0], 0);
  }
}

TEST_F(SimDriveTest, LeavesOrdersToOthersAlone) {
  out_.clear();
  drive_.on_frame(nmt_frame({NmtCommand::kStart, 2}), out_);
  EXPECT_EQ(drive_.nmt_state(), NmtState::kPreOperational);
  EXPECT_TRUE(out_.empty());
}

TEST_F(SimDriveTest, AnswersUploadsWithTheSizeOfTheObject) {
  EXPECT_EQ(ask({0x40, object::kDeviceType, 0}), 0x00020192U);
  EXPECT_EQ(command_, 0x43);
  ask({0x40, object::kStatusword, 0});
  EXPECT_EQ(command_, 0x4B);
  ask({0x40, object::kModeDisplay, 0});
  EXPECT_EQ(command_, 0x4F);
}

TEST_F(SimDriveTest, RefusesWhatTheStandardRefuses) {
  expect_abort(ask({0x40, {0x2001, 0}, 0}), SdoAbort::kNoObject);
  expect_abort(ask({0x40, {0x1018, 9}, 0}), SdoAbort::kNoSubIndex);
  expect_abort(write(object::kDeviceType, 4, 0), SdoAbort::kReadOnly);
  expect_abort(write(object::kTargetVelocity, 2, 0), SdoAbort::kLengthTooLow);
  expect_abort(write(object::kModeOfOperation, 4, 9), SdoAbort::kLengthTooHigh);
  expect_abort(write(object::kModeOfOperation, 1, 8), SdoAbort::kValueRange);
  expect_abort(write(object::kQuickStopOption, 2, 3), SdoAbort::kValueRange);
  expect_abort(write(object::kQuickStopOption, 2, 7), SdoAbort::kValueTooHigh);
  expect_abort(write(object::kQuickStopOption, 2, 0xFFFF), SdoAbort::kValueTooLow);
  expect_abort(write(object::kAbortConnectionOption, 2, 4), SdoAbort::kValueTooHigh);
  expect_abort(ask({0x21, object::kTargetVelocity, 65}), SdoAbort::kLengthTooHigh);
  expect_abort(ask({0xC0, object::kTargetVelocity, 4}), SdoAbort::kCommandSpecifier);
}

TEST_F(SimDriveTest, TakesAMappingOnlyInTheOrderOfTheStandard) {
  expect_abort(write(object::kRpdo1Count, 1, 0), SdoAbort::kAccess);
  write(object::kRpdo1CobId, 4, 0x80000201);
  expect_abort(write({0x1600, 1}, 4, 0x60FF0020), SdoAbort::kAccess);
  write(object::kRpdo1Count, 1, 0);
  expect_abort(write({0x1600, 1}, 4, 0x60410010), SdoAbort::kNotMappable);
  expect_abort(write({0x1600, 1}, 4, 0x60400020), SdoAbort::kNotMappable);
  expect_abort(write({0x1600, 1}, 4, 0x10000020), SdoAbort::kNotMappable);
  write({0x1600, 1}, 4, 0);
  expect_abort(write(object::kRpdo1Count, 1, 1), SdoAbort::kNotMappable);
  write({0x1600, 1}, 4, 0x60FF0020);
  write({0x1600, 2}, 4, 0x60FF0020);
  write({0x1600, 3}, 4, 0x60400010);
  EXPECT_EQ(command_, 0x60);
  expect_abort(write(object::kRpdo1Count, 1, 3), SdoAbort::kPdoLength);
  expect_abort(write(object::kRpdo1Count, 1, 9), SdoAbort::kValueTooHigh);
  write(object::kRpdo1Count, 1, 2);
  EXPECT_EQ(command_, 0x60);
  expect_abort(write({0x1600, 1}, 4, 0x60400010), SdoAbort::kAccess);
}

TEST_F(SimDriveTest, IgnoresShortRequestsAndAborts) {
  out_.clear();
  drive_.on_frame({.id = 0x601, .size = 4, .data = {0x40, 0x00, 0x10, 0x00}}, out_);
  drive_.on_frame(sdo_frame(0x601, {0x80, object::kDeviceType, 0x05040000}), out_);
  EXPECT_TRUE(out_.empty());
}

TEST_F(SimDriveTest, DoesNotAnswerSdoWhenStopped) {
  drive_.on_frame(nmt_frame({NmtCommand::kStop, 0}), out_);
  out_.clear();
  drive_.on_frame(sdo_frame(0x601, {0x40, object::kDeviceType, 0}), out_);
  EXPECT_TRUE(out_.empty());
}

TEST_F(SimDriveTest, SaysItsNewStateAtOnceWhenItProducesHeartbeats) {
  write(object::kProducerHeartbeat, 2, 50);
  out_.clear();
  drive_.on_frame(nmt_frame({NmtCommand::kStart, 1}), out_);
  ASSERT_EQ(out_.size(), 1U);
  EXPECT_EQ(out_[0], (hal::CanFrame{.id = 0x701, .size = 1, .data = {5}}));
}

TEST(SimMotion, RampsAndIntegratesInWholeNumbers) {
  DriveParameters drive;
  SimMotion motion(drive);
  // 1,000 units/s2 for 1 s, then 1 s at 1,000 units/s, then down again: 500 + 1,000 + 500 counts (one count is one unit
  // s).
  motion.advance(std::chrono::seconds(1), 1000, {1000, 1000});
  EXPECT_EQ(motion.velocity(), 1000);
  EXPECT_EQ(motion.position(), 500);
  motion.advance(std::chrono::seconds(1), 1000, {1000, 1000});
  motion.advance(std::chrono::seconds(1), 0, {1000, 1000});
  EXPECT_TRUE(motion.at_rest());
  EXPECT_EQ(motion.position(), 2000);
}

TEST(SimMotion, ComesOutTheSameHoweverTimeIsCut) {
  DriveParameters drive;
  SimMotion whole(drive);
  SimMotion cut(drive);
  whole.advance(milliseconds(600), 777, {5000, 5000});
  for (int i = 0; i < 300; ++i) {
    cut.advance(milliseconds(2), 777, {5000, 5000});
  }
  EXPECT_EQ(whole.position(), cut.position());
}

TEST(SimMotion, CountsInEncoderCountsWhateverTheUnitOfVelocity) {
  DriveParameters rpm;
  rpm.velocity_per_radps = 60.0 / (2.0 * std::acos(-1.0));
  SimMotion motion(rpm);
  motion.advance(std::chrono::seconds(60), 60, {4'000'000'000, 4'000'000'000});
  EXPECT_NEAR(motion.position(), 60 * 4096, 5) << "60 rpm for a minute are 60 turns";
}

TEST(SimMotion, SurvivesTheFastestTargets) {
  DriveParameters drive;
  SimMotion motion(drive);
  for (const std::int32_t target :
       {std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()}) {
    motion.advance(std::chrono::seconds(2), target, {4'294'967'295, 4'294'967'295});
    EXPECT_EQ(motion.velocity() > 0, target > 0);
  }
}

TEST(SimDrives, TheSameFramesInGiveTheSameFramesOut) {
  const auto run = [] {
    Rig rig;
    rig.targets.radps = {1.0, -2.0, 3.3, 4.7};
    EXPECT_TRUE(rig.enable_all());
    rig.run(milliseconds(700));
    rig.group.stop(rig.clock.now());
    rig.run(milliseconds(700));
    return rig.log;
  };
  EXPECT_EQ(run(), run());
}

/// The whole of a run with drives that take their time from SYNC, while the clock that they must not look at is wild.
TEST(SimDrives, TimeFromSyncIsMovedByNothingElse) {
  const auto run = [](int strides) {
    Rig rig({}, test_robot(), SimDrives::TimeFrom::kSync);
    rig.targets.radps.fill(3.0);
    rig.enable = false;
    for (int i = 0; i < 1000; ++i) {
      rig.enable = i > 100;
      rig.cycle();
      for (int extra = 0; extra < strides; ++extra) {
        rig.drives.update(Instant(std::chrono::hours(extra)));
      }
    }
    EXPECT_EQ(rig.feedback.state, GroupState::kEnabled) << describe(rig.feedback.fault);
    return rig.log;
  };
  EXPECT_EQ(run(0), run(5));
}

TEST(SimDrives, TheLastFeedbackIsTheLastFrameOfASync) {
  Rig rig({}, test_robot(), SimDrives::TimeFrom::kSync);
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  for (int i = 0; i < 100; ++i) {
    rig.cycle();
    EXPECT_EQ(rig.log.back().id, 0x184);
  }
  const auto beats = std::count_if(rig.log.begin(), rig.log.end(),
                                   [](const hal::CanFrame& frame) { return frame.id == 0x701 && frame.data[0] == 5; });
  EXPECT_GE(beats, 4) << "heartbeats go on, in SYNC's time";
}

TEST(SimDrives, AShortCommandIsRefusedWithAnEmergency) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.drives_run = false;
  rig.cycle();
  rig.inject({.id = 0x201, .size = 4, .data = {0x0F}});
  rig.drives_run = true;
  rig.cycle();
  rig.cycle();
  EXPECT_TRUE(std::any_of(rig.log.begin(), rig.log.end(), [](const hal::CanFrame& frame) {
    return frame.id == 0x081 && frame.data[0] == 0x10 && frame.data[1] == 0x82;
  }));
}

}  // namespace
}  // namespace ivo::drivers
