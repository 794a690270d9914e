#include "drivers/canopen/pdo_layout.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "config/rates.hpp"
#include "tests/unit/drivers/rig.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;

GroupChannels channels_of(const Robot& robot) {
  GroupChannels channels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channels[i] = standard_channels(robot, kAll[i]);
  }
  return channels;
}

GroupCommands words(std::uint16_t word) {
  GroupCommands commands{};
  for (DriveCommand& command : commands) {
    command.controlword = word;
  }
  return commands;
}

int count(const ControlwordsDue& due) { return static_cast<int>(std::count(due.begin(), due.end(), true)); }

TEST(PdoLayout, GivesEachDriveItsOwnCommandAndFeedback) {
  EXPECT_EQ(standard_channels(test_robot(), Wheel::kRearLeft), (PdoChannels{0x203, 0, 0x183}));
}

TEST(PdoLayout, LetsFrontAndRearDrivesShareTheirTargets) {
  const GroupChannels channels = channels_of(shared_robot());
  EXPECT_EQ(channels[0], (PdoChannels{0x201, 0x301, 0x181}));
  EXPECT_EQ(channels[1], (PdoChannels{0x202, 0x301, 0x182}));
  EXPECT_EQ(channels[2], (PdoChannels{0x203, 0x303, 0x183}));
  EXPECT_EQ(channels[3], (PdoChannels{0x204, 0x303, 0x184}));
}

TEST(PdoLayout, SendsOneCommandADrive) {
  const GroupCommands commands{{{0x0F, 1}, {0x0F, -1}, {0x0F, 2}, {0x0F, -2}}};
  const CommandFrames frames = command_frames(PdoLayout::kOwn, channels_of(test_robot()), commands, {});
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_EQ(frames[1], (hal::CanFrame{.id = 0x202, .size = 6, .data = {0x0F, 0, 0xFF, 0xFF, 0xFF, 0xFF}}));
  EXPECT_EQ(frames[2], (hal::CanFrame{.id = 0x203, .size = 6, .data = {0x0F, 0, 2, 0, 0, 0}}));
}

TEST(PdoLayout, SendsControlwordsThatAreDueThenTheTargetsOfBothPairs) {
  const GroupCommands commands{{{0x0F, 1}, {0x0F, -1}, {0x0F, 0x01020304}, {0x02, 0}}};
  const CommandFrames frames =
      command_frames(PdoLayout::kShared, channels_of(shared_robot()), commands, {false, false, true, true});
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_EQ(frames[0], (hal::CanFrame{.id = 0x203, .size = 2, .data = {0x0F, 0}}));
  EXPECT_EQ(frames[1], (hal::CanFrame{.id = 0x204, .size = 2, .data = {0x02, 0}}));
  EXPECT_EQ(frames[2], (hal::CanFrame{.id = 0x301, .size = 8, .data = {1, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF}}));
  EXPECT_EQ(frames[3], (hal::CanFrame{.id = 0x303, .size = 8, .data = {4, 3, 2, 1, 0, 0, 0, 0}}));
}

TEST(PdoLayout, UsesTheChannelsOfADriveThatCouldNotBeMapped) {
  GroupChannels channels = channels_of(test_robot());
  channels[2].command_id = 0x503;
  const CommandFrames frames = command_frames(PdoLayout::kOwn, channels, words(0x06), {});
  EXPECT_EQ(frames[2].id, 0x503);
}

TEST(PdoLayout, ReadsAPairOfTargetsOfExactlyEightBytes) {
  hal::CanFrame frame = target_pair_frame(0x301, {-5, 7});
  const auto targets = parse_target_pair(frame);
  ASSERT_TRUE(targets.has_value());
  EXPECT_EQ(targets->first, -5);
  EXPECT_EQ(targets->second, 7);
  for (frame.size = 0; frame.size < 8; ++frame.size) {
    EXPECT_FALSE(parse_target_pair(frame).has_value());
  }
}

TEST(ControlwordSchedule, SendsAllFourAtFirstAndEachAtOnceWhenItChanges) {
  ControlwordSchedule schedule;
  GroupCommands commands = words(0x06);
  EXPECT_EQ(count(schedule.due(commands, Instant{})), 4);
  EXPECT_EQ(count(schedule.due(commands, Instant(milliseconds(1)))), 0);
  commands[2].controlword = 0x02;
  commands[2].target_velocity = 9;
  EXPECT_EQ(schedule.due(commands, Instant(milliseconds(2))), (ControlwordsDue{false, false, true, false}));
  commands[1].target_velocity = 9;
  EXPECT_EQ(count(schedule.due(commands, Instant(milliseconds(3)))), 0) << "a target is no controlword";
}

TEST(ControlwordSchedule, RefreshesEachOneInTimeAndNoTwoTogether) {
  ControlwordSchedule schedule;
  const GroupCommands commands = words(0x0F);
  std::array<Instant, kWheels> last{};
  for (Instant now{}; now < Instant(std::chrono::seconds(2)); now += milliseconds(1)) {
    const ControlwordsDue due = schedule.due(commands, now);
    EXPECT_LE(count(due), now == Instant{} ? 4 : 1);
    for (std::size_t i = 0; i < due.size(); ++i) {
      EXPECT_LE(now - last[i], rates::kControlwordRefresh);
      last[i] = due[i] ? now : last[i];
    }
  }
}

TEST(ControlwordSchedule, SendsAllAgainWhenTheyMayNotHaveLeft) {
  ControlwordSchedule schedule;
  (void)schedule.due(words(0x0F), Instant{});
  schedule.forget();
  EXPECT_EQ(count(schedule.due(words(0x0F), Instant(milliseconds(1)))), 4);
}

}  // namespace
}  // namespace ivo::drivers
