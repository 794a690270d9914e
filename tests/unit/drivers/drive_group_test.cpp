// Four drives as one over the virtual bus: up together, moving together, stopped together.
#include "drivers/drive_group.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;
using std::chrono::milliseconds;

TEST(DriveGroup, TurnsEachWheelAsAskedWhateverSignAndGear) {
  Rig rig;
  rig.targets.radps = {1.0, 2.0, -3.0, 0.0};
  ASSERT_TRUE(rig.enable_all());
  rig.run(milliseconds(1000));
  for (std::size_t i = 0; i < kWheels; ++i) {
    EXPECT_NEAR(rig.feedback.radps[i], rig.targets.radps[i], 0.05);
    EXPECT_NEAR(rig.feedback.angle_rad[i], rig.targets.radps[i], 0.2);
  }
}

TEST(DriveGroup, SendsSyncFirstThenFourCommandsEachCycle) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.run(milliseconds(60));
  const std::size_t before = rig.log.size();
  rig.cycle();
  std::vector<std::uint16_t> ids;
  for (std::size_t i = before; i < rig.log.size(); ++i) {
    if ((rig.log[i].id & 0x780) != 0x700) {
      ids.push_back(rig.log[i].id);
    }
  }
  EXPECT_EQ(ids, (std::vector<std::uint16_t>{0x080, 0x201, 0x202, 0x203, 0x204, 0x181, 0x182, 0x183, 0x184}));
}

TEST(DriveGroup, SendsItsHeartbeatAfterTheCommands) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.run(milliseconds(200));
  int heartbeats = 0;
  for (std::size_t i = 1; i < rig.log.size(); ++i) {
    if (rig.log[i].id == 0x77F && std::any_of(rig.log.begin(), rig.log.begin() + static_cast<std::ptrdiff_t>(i),
                                              [](const hal::CanFrame& frame) { return frame.id == 0x080; })) {
      EXPECT_EQ(rig.log[i - 1].id, 0x204);
      ++heartbeats;
    }
  }
  EXPECT_GE(heartbeats, 3);
}

TEST(DriveGroup, SaysNothingBeforeOpen) {
  hal::VirtualBus bus;
  DriveGroup group(bus.port(0), test_robot());
  std::array<hal::ReceivedFrame, 8> frames;
  group.update(Instant{});
  group.write(Instant{}, false, {});
  EXPECT_EQ(bus.port(1).receive(frames, Instant{}), 0U);
}

TEST(DriveGroup, EnablesInLockstepOneTransitionForEachConfirmedStatusOfAll) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.enable = true;
  while (rig.cycle().state != GroupState::kEnabled) {
    ASSERT_NE(rig.feedback.state, GroupState::kFault);
    const PowerState first = rig.drives.drive(Wheel::kFrontLeft).power_state();
    for (const Wheel wheel : kAll) {
      EXPECT_EQ(rig.drives.drive(wheel).power_state(), first);
    }
  }
}

TEST(DriveGroup, SendsNoTargetBeforeAllFourAreEnabled) {
  Rig rig;
  rig.targets.radps.fill(5.0);
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.enable = true;
  while (rig.cycle().state != GroupState::kEnabled) {
    for (std::uint8_t node = 1; node <= 4; ++node) {
      EXPECT_EQ(target_of(rig.last_command(node)), 0);
    }
  }
  EXPECT_NE(target_of(rig.last_command(1)), 0);
}

TEST(DriveGroup, WantsEnableToHaveBeenFalseBeforeItCounts) {
  Rig rig;
  rig.enable = true;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.run(milliseconds(200));
  EXPECT_EQ(rig.feedback.state, GroupState::kReady);
  rig.enable = false;
  rig.cycle();
  rig.enable = true;
  EXPECT_TRUE(rig.run_until(GroupState::kEnabled));
}

TEST(DriveGroup, WithoutEnableComesToRestAndShutsDown) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.enable = false;
  rig.cycle();
  expect_stopped_command(rig);
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.run(milliseconds(100));
  EXPECT_TRUE(rig.feedback.standstill);
  EXPECT_EQ(controlword_of(rig.last_command(1)), 0x06);
  EXPECT_EQ(rig.drives.drive(Wheel::kRearRight).power_state(), PowerState::kReadyToSwitchOn);
  rig.enable = true;
  EXPECT_TRUE(rig.run_until(GroupState::kEnabled)) << "and may be enabled again";
}

TEST(DriveGroup, WithoutEnableSendsNothingThatCouldMoveAWheel) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  rig.enable = false;
  for (int i = 0; i < 500; ++i) {
    rig.cycle();
    for (std::uint8_t node = 1; node <= 4; ++node) {
      EXPECT_NE(controlword_of(rig.last_command(node)), 0x0F);
      EXPECT_EQ(target_of(rig.last_command(node)), 0);
    }
  }
}

TEST(DriveGroup, StopIsAQuickStopThenVoltageOffAndMayBeRepeated) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  for (int i = 0; i < 10; ++i) {
    rig.group.stop(rig.clock.now());
    rig.cycle();
    expect_stopped_command(rig);
    EXPECT_EQ(rig.feedback.state, i == 0 ? GroupState::kStopping : rig.feedback.state);
  }
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.run(milliseconds(10));
  EXPECT_EQ(controlword_of(rig.last_command(2)), 0x00);
  EXPECT_TRUE(all_at_rest(rig));
  rig.run(milliseconds(500));
  EXPECT_EQ(rig.feedback.state, GroupState::kReady) << "enable is still true, but was not false since the stop";
}

TEST(DriveGroup, StopWhileEnablingSwitchesOff) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  rig.enable = true;
  ASSERT_TRUE(rig.run_until(GroupState::kEnabling));
  rig.group.stop(rig.clock.now());
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  EXPECT_FALSE(any_enabled(rig));
}

TEST(DriveGroup, HoldsATargetBeyondThirtyTwoBitsAndRefusesNotANumber) {
  Rig rig;
  rig.targets.radps = {1e300, -1e300, std::numeric_limits<double>::quiet_NaN(),
                       std::numeric_limits<double>::infinity()};
  ASSERT_TRUE(rig.enable_all());
  EXPECT_EQ(target_of(rig.last_command(1)), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(target_of(rig.last_command(2)), std::numeric_limits<std::int32_t>::max()) << "sign -1";
  EXPECT_EQ(target_of(rig.last_command(3)), 0);
  EXPECT_EQ(target_of(rig.last_command(4)), std::numeric_limits<std::int32_t>::min()) << "sign -1";
}

TEST(DriveGroup, OneLostFeedbackIsForgivenAndLosesNoDistance) {
  Rig rig;
  ASSERT_TRUE(rig.drive_at(5.0));
  SimScript& script = rig.drives.drive(Wheel::kFrontLeft).script();
  script.feedback_lost_from = Instant{};
  rig.cycle();
  rig.cycle();
  EXPECT_FALSE(rig.feedback.fresh);
  script.feedback_lost_from = SimScript::kNever;
  rig.run(milliseconds(100));
  EXPECT_EQ(rig.feedback.state, GroupState::kEnabled);
  EXPECT_DOUBLE_EQ(rig.feedback.angle_rad[0], rig.feedback.angle_rad[2]);
}

TEST(DriveGroup, ExpectsOneAnswerFromEachDriveWhileItStartsUpAndNoneAfterwards) {
  Rig rig;
  EXPECT_EQ(rig.group.answers_awaited(), 0) << "nothing was sent yet";
  rig.group.update(rig.clock.now());
  rig.group.write(rig.clock.now(), false, {});
  EXPECT_EQ(rig.group.answers_awaited(), 4);
  EXPECT_TRUE(rig.group.awaiting_answer());
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  EXPECT_FALSE(rig.group.awaiting_answer());
}

TEST(DriveGroup, SurvivesAnyFrameFromAnyone) {
  Rig rig;
  ASSERT_TRUE(rig.run_until(GroupState::kReady));
  std::uint32_t random = 12345;
  const auto next = [&random] { return random = random * 1664525U + 1013904223U; };
  for (int i = 0; i < 20'000; ++i) {
    hal::CanFrame frame{.id = static_cast<std::uint16_t>(next() >> 21),
                        .size = static_cast<std::uint8_t>((next() >> 16) % 9),
                        .data = {}};
    for (std::uint8_t& byte : frame.data) {
      byte = static_cast<std::uint8_t>(next() >> 24);
    }
    rig.inject(frame);
    if (i % 10 == 0) {
      rig.cycle();
    }
  }
  EXPECT_NE(rig.feedback.state, GroupState::kEnabled) << "enable was never asked for";
}

}  // namespace
}  // namespace ivo::drivers
