#include "firmware/tools/drives_command.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "drivers/canopen/nmt.hpp"
#include "firmware/tools/drives_log.hpp"
#include "hal/sim/virtual_bus.hpp"
#include "tests/support/scratch_folder.hpp"

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

TEST(DrivesCommand, TakesFilesThatSayWhatTheDrivesAreAndDo) {
  const auto options = parse({"--eds", "d.eds", "--script", "s.toml", "--log", "l.txt", "--can", "can1"});
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options.value().eds_path, "d.eds");
  EXPECT_EQ(options.value().script_path, "s.toml");
  EXPECT_EQ(options.value().log_path, "l.txt");
}

TEST(DrivesCommand, RefusesFilesThatAreNotThereBeforeItTouchesTheBus) {
  for (std::string DrivesOptions::*path :
       {&DrivesOptions::eds_path, &DrivesOptions::script_path, &DrivesOptions::log_path}) {
    DrivesOptions options;
    options.interface = "can7";
    options.*path = "/there/is/nothing";
    std::ostringstream out;
    const std::atomic<bool> stop{true};
    const auto ran = run_drives(options, stop, out);
    ASSERT_FALSE(ran.ok());
    EXPECT_EQ(ran.error().message.find("can7"), std::string::npos) << ran.error().message;
    EXPECT_NE(ran.error().message.find("/there/is/nothing"), std::string::npos) << ran.error().message;
  }
}

TEST(DrivesLog, HasALineForEachChangeAndNoneTwice) {
  const ScratchFolder folder;
  const std::string path = folder.path("drives.txt");
  hal::VirtualBus bus;
  drivers::SimDrives drives(bus.port(1), Robot{}, drivers::SimDrives::TimeFrom::kClock);
  drives.open();
  DrivesLog log;
  ASSERT_TRUE(log.open(path).ok());
  log.write(drives);
  log.write(drives);
  const hal::CanFrame stop = drivers::nmt_frame({drivers::NmtCommand::kStop, 2});
  bus.port(0).send({&stop, 1}, Instant{});
  drives.update(Instant(std::chrono::milliseconds(1500)));
  log.write(drives);
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(),
            "t_s=0.000000 node=1 nmt=pre_operational power=switch_on_disabled velocity=0 wheel=rests\n"
            "t_s=0.000000 node=2 nmt=pre_operational power=switch_on_disabled velocity=0 wheel=rests\n"
            "t_s=0.000000 node=3 nmt=pre_operational power=switch_on_disabled velocity=0 wheel=rests\n"
            "t_s=0.000000 node=4 nmt=pre_operational power=switch_on_disabled velocity=0 wheel=rests\n"
            "t_s=1.500000 node=2 nmt=stopped power=switch_on_disabled velocity=0 wheel=rests\n");
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
