#include "firmware/files/robot_file.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string_view>

#include "config/rates.hpp"
#include "drivers/canopen/bus_load.hpp"
#include "firmware/files/eds_file.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/robot_inputs.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/files/toml_table.hpp"
#include "firmware/files/wheel_keys.hpp"

namespace ivo::firmware {
namespace {

BaseParameters read_base(const TomlValue& table) {
  BaseParameters base;
  base.geometry = static_cast<WheelGeometry>(table.required("geometry").choice({"mecanum", "omni_x"}));
  base.wheel_radius_m = table.required("wheel_radius_m").number({0.01, 1.0, "metres"});
  base.half_length_m = table.required("half_length_m").number({0.05, 2.0, "metres"});
  base.half_width_m = table.required("half_width_m").number({0.05, 2.0, "metres"});
  base.max_wheel_radps = table.required("max_wheel_radps").number({0.1, 1000.0, "radians a second"});
  base.turn_scale = table.optional("turn_scale").number({0.5, 2.0}, 1.0);
  return base;
}

MotionLimits read_limits(const TomlValue& table) {
  MotionLimits limits;
  limits.max_speed_mps = table.required("max_speed_mps").number({0.05, 3.0, "metres a second"});
  limits.max_turn_radps = table.required("max_turn_radps").number({0.05, 10.0, "radians a second"});
  limits.max_accel_mps2 = table.required("max_accel_mps2").number({0.05, 10.0, "metres a second squared"});
  limits.max_turn_accel_radps2 =
      table.required("max_turn_accel_radps2").number({0.05, 50.0, "radians a second squared"});
  const TomlValue stop = table.required("stop_decel_mps2");
  limits.stop_decel_mps2 = stop.number({0.05, 20.0, "metres a second squared"});
  if (stop.present() && limits.stop_decel_mps2 < limits.max_accel_mps2) {
    stop.complain(shortest(limits.stop_decel_mps2) +
                  " is gentler than ordinary braking; expected at least max_accel_mps2, " +
                  shortest(limits.max_accel_mps2));
  }
  const double most_s = seconds(rates::kStandstillTimeout) - 1.0;
  const TomlValue quick = table.optional("quick_stop_mps2");
  limits.quick_stop_mps2 = quick.number({0.05, 40.0, "metres a second squared"}, 2.0 * limits.stop_decel_mps2);
  if (quick.present() && limits.quick_stop_mps2 < limits.stop_decel_mps2) {
    quick.complain(shortest(limits.quick_stop_mps2) +
                   " is gentler than the loop's own stop; expected at least "
                   "stop_decel_mps2, " +
                   shortest(limits.stop_decel_mps2));
  }
  if (stop.present() && limits.max_speed_mps > limits.stop_decel_mps2 * most_s) {
    stop.complain(shortest(limits.stop_decel_mps2) + " does not stop the robot from max_speed_mps within " +
                  shortest(most_s) + " s; expected at least " + shortest(limits.max_speed_mps / most_s));
  }
  return limits;
}

constexpr std::array<std::uint32_t, 8> kBitRates = {10'000,  20'000,  50'000,  125'000,
                                                    250'000, 500'000, 800'000, 1'000'000};  // CiA 301, table 1

bool fits_at(Robot robot, std::uint32_t bit_rate_bps) {
  robot.bit_rate_bps = bit_rate_bps;
  return drivers::fits(robot);
}

/// "800000 or 1000000"; 1 Mbit/s carries every layout at 500 Hz.
std::string bit_rates_that_fit(const Robot& robot) {
  std::string rates;
  for (const std::uint32_t rate : kBitRates) {
    if (fits_at(robot, rate)) {
      rates += (rates.empty() ? "" : " or ") + std::to_string(rate);
    }
  }
  return rates;
}

// What every cycle sends has to fit into it, on a bit rate that interfaces have (drivers/canopen/bus_load.hpp).
void read_bus(Robot& robot, const TomlValue& bus) {
  const TomlValue rate = bus.required("bit_rate_bps");
  robot.bit_rate_bps = static_cast<std::uint32_t>(rate.integer(10'000, 1'000'000));
  robot.master_node_id = static_cast<std::uint8_t>(bus.required("master_node_id").integer(1, 127));
  robot.pdo_layout = static_cast<PdoLayout>(bus.optional("pdo_layout").choice({"own", "shared"}));
  const TomlValue cycle = bus.optional("cycle_ms");
  robot.cycle = std::chrono::milliseconds(cycle.integer(1, 2, 2));
  if (robot.bit_rate_bps == 0 || robot.cycle == Duration::zero()) {
    return;  // of these there is a complaint already
  }
  const bool standard = std::find(kBitRates.begin(), kBitRates.end(), robot.bit_rate_bps) != kBitRates.end();
  if (standard && drivers::fits(robot)) {
    return;
  }
  if (robot.cycle < rates::kCycle) {
    cycle.complain("1 does not fit on this bus; expected 2, or pdo_layout = \"shared\" and bit_rate_bps = 1000000");
  } else {
    rate.complain(std::to_string(robot.bit_rate_bps) + " does not carry four drives at 500 Hz; expected " +
                  bit_rates_that_fit(robot));
  }
}

LoopParameters read_loop(const TomlValue& table) {
  LoopParameters loop;
  loop.ramp_down_at = static_cast<int>(table.optional("ramp_down_at").integer(2, 24, loop.ramp_down_at));
  const TomlValue latch = table.optional("latch_at");
  loop.latch_at = static_cast<int>(latch.integer(3, 25, loop.latch_at));
  if (loop.latch_at <= loop.ramp_down_at) {
    (latch.present() ? latch : table)
        .complain("latch_at is " + std::to_string(loop.latch_at) + "; expected more than ramp_down_at, " +
                  std::to_string(loop.ramp_down_at));
  }
  loop.priority = static_cast<int>(table.optional("priority").integer(1, 99, loop.priority));
  if (const TomlValue cpu = table.optional("cpu"); cpu.present()) {
    loop.cpu = static_cast<int>(cpu.integer(0, 1023));
  }
  loop.beat_timeout =
      from_seconds(table.optional("operator_timeout_s").number({0.5, 60.0, "seconds"}, seconds(loop.beat_timeout)));
  return loop;
}

DriveParameters read_drive(const TomlValue& table, const std::string& path) {
  DriveParameters drive;
  drive.node_id = static_cast<std::uint8_t>(table.required("node_id").integer(1, 126));
  const TomlValue sign = table.required("sign");
  drive.sign = static_cast<int>(sign.integer(-1, 1, 1));
  if (drive.sign == 0) {
    sign.complain("0 is no direction; expected 1 or -1");
  }
  drive.gear_ratio = table.required("gear_ratio").number({0.01, 1000.0, "motor turns for one wheel turn"});
  drive.counts_per_turn = table.required("counts_per_turn").number({1.0, 1e8, "counts for one motor turn"});
  drive.velocity_per_radps = table.required("velocity_per_radps").number({1e-3, 1e9, "units of 60FFh for 1 rad/s"});
  drive.accel_per_radps2 =
      table.optional("accel_per_radps2").number({1e-3, 1e9, "units of 6083h for 1 rad/s2"}, drive.velocity_per_radps);
  const TomlValue eds = table.optional("eds");
  drive.eds = eds.is_text() ? beside(path, eds.text()) : eds.text();
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
  drive.vendor_id = static_cast<std::uint32_t>(table.optional("vendor_id").integer(0, kMost));
  drive.product_code = static_cast<std::uint32_t>(table.optional("product_code").integer(0, kMost));
  return drive;
}

// A target of 60FFh has 32 bits, and below some hundred units at full speed it would be too coarse to steer with.
void refuse_units_that_do_not_fit(const TomlValue& drives, const Robot& robot) {
  constexpr double kLeast = 100.0;
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  for (std::size_t i = 0; i < kWheelKeys.size(); ++i) {
    const DriveParameters& drive = robot.drives[i];
    const double full_speed = robot.base.max_wheel_radps * drive.gear_ratio * drive.velocity_per_radps;
    const TomlValue units = drives.optional(kWheelKeys[i]).optional("velocity_per_radps");
    if (units.present() && (full_speed < kLeast || full_speed > kMost)) {
      units.complain("makes base.max_wheel_radps " + shortest(full_speed) +
                     " units of 60FFh; expected 100 to 2147483647 of them");
    }
  }
}

void refuse_shared_node_ids(const TomlValue& drives, const Robot& robot) {
  for (std::size_t i = 0; i < kWheelKeys.size(); ++i) {
    const TomlValue node_id = drives.optional(kWheelKeys[i]).optional("node_id");
    if (!node_id.present() || robot.drives[i].node_id == 0) {
      continue;
    }
    const std::string id = std::to_string(robot.drives[i].node_id);
    if (robot.drives[i].node_id == robot.master_node_id) {
      node_id.complain(id + " is the master's (bus.master_node_id); expected a node-id of its own");
    }
    for (std::size_t earlier = 0; earlier < i; ++earlier) {
      if (robot.drives[i].node_id == robot.drives[earlier].node_id) {
        node_id.complain(id + " is already drive." + std::string(kWheelKeys[earlier]) +
                         "'s; expected a node-id of its own");
      }
    }
  }
}

void refuse_drives_that_cannot_be_told_all(const TomlValue& drives, const Robot& robot) {
  for (std::size_t i = 0; i < kWheelKeys.size(); ++i) {
    if (const Result<void> fit = check_drive_eds(robot, static_cast<Wheel>(i)); !fit) {
      drives.optional(kWheelKeys[i]).optional("eds").complain(fit.error().message);
    }
  }
}

}  // namespace

Result<Robot> read_robot(const std::string& path) {
  const Result<TomlFile> toml = TomlFile::read(path);
  if (!toml) {
    return toml.error();
  }
  const TomlValue root = toml.value().root();
  Robot robot;
  robot.name = root.optional("name").text(std::filesystem::path(path).stem().string());
  robot.footprint_radius_m = root.required("footprint_radius_m").number({0.05, 2.0, "metres"});
  robot.base = read_base(root.required("base"));
  robot.limits = read_limits(root.required("limits"));
  read_bus(robot, root.required("bus"));
  const TomlValue drives = root.required("drive");
  for (std::size_t i = 0; i < kWheelKeys.size(); ++i) {
    robot.drives[i] = read_drive(drives.required(kWheelKeys[i]), path);
  }
  robot.inputs = read_inputs(root.optional("inputs"));
  robot.loop = read_loop(root.optional("loop"));
  refuse_shared_node_ids(drives, robot);
  refuse_units_that_do_not_fit(drives, robot);
  if (const Result<void> finish = toml.value().finish(); !finish) {
    return finish.error();
  }
  refuse_drives_that_cannot_be_told_all(drives, robot);  // what is told depends on all of the above
  if (const Result<void> finish = toml.value().finish(); !finish) {
    return finish.error();
  }
  return robot;
}

}  // namespace ivo::firmware
