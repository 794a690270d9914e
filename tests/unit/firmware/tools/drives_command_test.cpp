#include "firmware/tools/drives_command.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace ivo::firmware {
namespace {

Result<DrivesOptions> parse(const std::vector<const char*>& arguments) { return parse_drives_options(arguments); }

TEST(DrivesCommand, NeedsOnlyTheInterface) {
  const auto options = parse({"--can", "vcan0"});
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options.value().interface, "vcan0");
  EXPECT_EQ(options.value().robot_path, "");
  EXPECT_EQ(options.value().time_from, drivers::SimDrives::TimeFrom::kClock);
}

TEST(DrivesCommand, TakesTimeFromSyncWhenAsked) {
  const auto options = parse({"--clock", "sync", "--robot", "a.toml", "--can", "can1"});
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options.value().time_from, drivers::SimDrives::TimeFrom::kSync);
  EXPECT_EQ(options.value().robot_path, "a.toml");
}

TEST(DrivesCommand, RefusesWrongArgumentsInOneLineThatNamesThem) {
  EXPECT_EQ(parse({}).error().message, "--can IFACE is missing: the CAN interface to simulate drives on, as vcan0");
  EXPECT_EQ(parse({"--can"}).error().message, "--can expects a value");
  EXPECT_EQ(parse({"--can", "c", "--clock", "fast"}).error().message, "--clock is real or sync, not \"fast\"");
  EXPECT_EQ(parse({"--bus", "c"}).error().message,
            "unknown argument \"--bus\": expected --can, --robot, --eds, --script, --log or --clock");
}

TEST(DrivesCommand, RefusesARobotFileThatIsNotThereBeforeItTouchesTheBus) {
  DrivesOptions options;
  options.interface = "can7";
  options.robot_path = "/there/is/no/robot.toml";
  std::ostringstream out;
  const std::atomic<bool> stop{true};
  const auto ran = run_drives(options, stop, out);
  ASSERT_FALSE(ran.ok());
  EXPECT_NE(ran.error().message.find("/there/is/no/robot.toml"), std::string::npos);
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace ivo::firmware
