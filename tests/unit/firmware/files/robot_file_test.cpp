#include "firmware/files/robot_file.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "firmware/files/text_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"

namespace ivo::firmware {
namespace {

std::string drive(const std::string& wheel, int node_id) {
  return "[drive." + wheel + "]\nnode_id = " + std::to_string(node_id) +
         "\nsign = 1\ngear_ratio = 2\ncounts_per_turn = 100\nvelocity_per_radps = 10\n";
}

const std::string kRobot =
    "footprint_radius_m = 0.3\n"                                                 // 1
    "[base]\ngeometry = 'omni_x'\nwheel_radius_m = 0.1\nhalf_length_m = 0.2\n"   // 2 to 5
    "half_width_m = 0.25\nmax_wheel_radps = 15\n"                                // 6, 7
    "[limits]\nmax_speed_mps = 0.5\nmax_turn_radps = 1\nmax_accel_mps2 = 0.5\n"  // 8 to 11
    "max_turn_accel_radps2 = 1.5\nstop_decel_mps2 = 1\n"                         // 12, 13
    "[bus]\nbit_rate_bps = 800000\nmaster_node_id = 100\n" +                     // 14 to 16
    drive("front_left", 1) +
    drive("front_right", 2) + drive("rear_left", 3) +                       // 17, 23, 29
    drive("rear_right", 4) + "vendor_id = 0xFFFFFFFF\nproduct_code = 5\n";  // 35, 41, 42

std::string complaint_about_robot(std::string_view from, std::string_view to) {
  const ScratchFolder folder;
  return replaced(message_of(read_robot(folder.put("r.toml", replaced(kRobot, from, to)))), folder.path() + "/", "");
}

TEST(RobotFile, ReadsEveryField) {
  const ScratchFolder folder;
  const auto robot = read_robot(folder.put("rover.toml", kRobot));
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  const Robot& r = robot.value();
  EXPECT_EQ(r.name, "rover");
  EXPECT_EQ(r.footprint_radius_m, 0.3);
  EXPECT_EQ(r.base.geometry, WheelGeometry::kOmniX);
  EXPECT_EQ(r.base.wheel_radius_m, 0.1);
  EXPECT_EQ(r.base.half_length_m, 0.2);
  EXPECT_EQ(r.base.half_width_m, 0.25);
  EXPECT_EQ(r.base.max_wheel_radps, 15);
  EXPECT_EQ(r.limits.max_speed_mps, 0.5);
  EXPECT_EQ(r.limits.max_turn_radps, 1);
  EXPECT_EQ(r.limits.max_accel_mps2, 0.5);
  EXPECT_EQ(r.limits.max_turn_accel_radps2, 1.5);
  EXPECT_EQ(r.limits.stop_decel_mps2, 1);
  EXPECT_EQ(r.bit_rate_bps, 800'000U);
  EXPECT_EQ(r.master_node_id, 100);
  for (std::size_t i = 0; i < r.drives.size(); ++i) {
    EXPECT_EQ(r.drives[i].node_id, i + 1);
    EXPECT_EQ(r.drives[i].gear_ratio, 2);
    EXPECT_EQ(r.drives[i].counts_per_turn, 100);
    EXPECT_EQ(r.drives[i].velocity_per_radps, 10);
  }
  EXPECT_EQ(r.drives[3].vendor_id, 0xFFFFFFFFU);
  EXPECT_EQ(r.drives[3].product_code, 5U);
  EXPECT_EQ(r.drives[0].vendor_id, 0U);
}

TEST(RobotFile, RefusesNodeIdsThatAreSharedOrOutOfRange) {
  EXPECT_EQ(complaint_about_robot("node_id = 3", "node_id = 1"),
            "r.toml:30: drive.rear_left.node_id: 1 is already drive.front_left's; expected a node-id of its own");
  EXPECT_EQ(
      complaint_about_robot("node_id = 3", "node_id = 100"),
      "r.toml:30: drive.rear_left.node_id: 100 is the master's (bus.master_node_id); expected a node-id of its own");
  EXPECT_EQ(complaint_about_robot("node_id = 3", "node_id = 127"),
            "r.toml:30: drive.rear_left.node_id: 127 is out of range; expected 1 to 126");
  EXPECT_EQ(complaint_about_robot("node_id = 3", "node_id = 0"),
            "r.toml:30: drive.rear_left.node_id: 0 is out of range; expected 1 to 126");
}

TEST(RobotFile, RefusesASignThatIsNoDirection) {
  EXPECT_EQ(complaint_about_robot("sign = 1", "sign = 0"),
            "r.toml:19: drive.front_left.sign: 0 is no direction; expected 1 or -1");
  EXPECT_EQ(complaint_about_robot("sign = 1", "sign = 2"),
            "r.toml:19: drive.front_left.sign: 2 is out of range; expected -1 to 1");
}

TEST(RobotFile, RefusesAStopThatIsGentlerThanBraking) {
  EXPECT_EQ(
      complaint_about_robot("stop_decel_mps2 = 1", "stop_decel_mps2 = 0.4"),
      "r.toml:13: limits.stop_decel_mps2: 0.4 is gentler than ordinary braking; expected at least max_accel_mps2, "
      "0.5");
}

TEST(RobotFile, RefusesAStopThatTakesTooLong) {
  EXPECT_EQ(complaint_about_robot("max_speed_mps = 0.5", "max_speed_mps = 2.5"),
            "r.toml:13: limits.stop_decel_mps2: 1 does not stop the robot from max_speed_mps within 2 s; expected at "
            "least 1.25");
}

TEST(RobotFile, RefusesBitRatesThatAreNoneOrTooSlow) {
  for (const std::string rate : {"500000", "600000", "250000"}) {
    EXPECT_EQ(
        complaint_about_robot("800000", rate),
        "r.toml:15: bus.bit_rate_bps: " + rate + " does not carry four drives at 500 Hz; expected 800000 or 1000000");
  }
}

TEST(RobotFile, RefusesUnitsInWhichFullSpeedDoesNotFit) {
  EXPECT_EQ(
      complaint_about_robot("velocity_per_radps = 10", "velocity_per_radps = 1e8"),
      "r.toml:22: drive.front_left.velocity_per_radps: makes base.max_wheel_radps 3000000000 units of 60FFh; expected "
      "100 to 2147483647 of them");
  EXPECT_EQ(complaint_about_robot("velocity_per_radps = 10", "velocity_per_radps = 1"),
            "r.toml:22: drive.front_left.velocity_per_radps: makes base.max_wheel_radps 30 units of 60FFh; expected "
            "100 to 2147483647 of them");
}

TEST(RobotFile, RefusesAWheelThatIsMissing) {
  EXPECT_EQ(complaint_about_robot(drive("rear_left", 3), ""), "r.toml:17: drive.rear_left: missing; it must be given");
}

TEST(RobotFile, RefusesUnknownGeometryUnknownKeysAndOtherUnits) {
  EXPECT_EQ(complaint_about_robot("'omni_x'", "'tank'"),
            "r.toml:3: base.geometry: \"tank\" is unknown; expected \"mecanum\" or \"omni_x\"");
  EXPECT_EQ(complaint_about_robot("wheel_radius_m = 0.1", "wheel_radius_mm = 100"),
            "r.toml:4: base.wheel_radius_mm: unknown; this quantity is given as wheel_radius_m, in metres");
  EXPECT_EQ(complaint_about_robot("sign = 1", "sign = 1\ntorque = 3"),
            "r.toml:20: drive.front_left.torque: unknown; expected one of node_id, sign, gear_ratio, counts_per_turn, "
            "velocity_per_radps, accel_per_radps2, eds, vendor_id, product_code");
}

// Every number of the file, made far too large: no field is read without a range.
TEST(RobotFile, RefusesEveryNumberOutOfRange) {
  std::size_t at = 0;
  int numbers = 0;
  while ((at = kRobot.find(" = ", at)) != std::string::npos) {
    at += 3;
    const std::size_t end = kRobot.find('\n', at);
    if (kRobot[at] == '\'') {
      continue;
    }
    const ScratchFolder folder;
    const std::string text = kRobot.substr(0, at) + "999999999999" + kRobot.substr(end);
    const std::string message = message_of(read_robot(folder.put("r.toml", text)));
    EXPECT_NE(message.find("999999999999 is out of range; expected "), std::string::npos) << text << message;
    ++numbers;
  }
  EXPECT_EQ(numbers, 34);
}

TEST(RobotFile, ReadsHowLongItGoesOnWithoutItsOperator) {
  const ScratchFolder folder;
  const auto usual = read_robot(folder.put("r.toml", kRobot));
  ASSERT_TRUE(usual.ok());
  EXPECT_EQ(usual.value().loop.beat_timeout, LoopParameters{}.beat_timeout);
  const auto robot =
      read_robot(folder.put("r.toml", replaced(kRobot, "[bus]", "[loop]\noperator_timeout_s = 0.5\n[bus]")));
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  EXPECT_EQ(robot.value().loop.beat_timeout, std::chrono::milliseconds(500));
  for (const char* const wrong : {"0.49", "61", "nan", "-1"}) {
    const std::string said =
        complaint_about_robot("[bus]", std::string("[loop]\noperator_timeout_s = ") + wrong + "\n[bus]");
    EXPECT_EQ(said.rfind("r.toml:15: loop.operator_timeout_s: ", 0), 0U) << said;
  }
}

}  // namespace
}  // namespace ivo::firmware
