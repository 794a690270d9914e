#include "drivers/startup_ramp_steps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {
namespace {

/// `mps2` at a wheel's rim, in units of 6083h to 6085h; at least 1, or the wheel would never stop.
std::uint32_t ramp_units(const Robot& robot, const DriveParameters& drive, double mps2) noexcept {
  constexpr double kHighest = 0x7FFF'FFFF;  // some drives hold it as signed
  const double units = mps2 / robot.base.wheel_radius_m * drive.gear_ratio * std::abs(drive.accel_per_radps2);
  return std::isfinite(units) ? static_cast<std::uint32_t>(std::clamp(std::round(units), 1.0, kHighest)) : 1;
}

/// The fastest that the loop's own ramps change a rim's speed: along a diagonal a mecanum wheel's rim does sqrt(2) of
/// what the base does, and a turn comes on top at its lever arm (config/robot.hpp; kinematics).
double steepest_command_mps2(const Robot& robot) noexcept {
  const MotionLimits& limits = robot.limits;
  const double lever_m = robot.base.half_length_m + robot.base.half_width_m;
  return std::numbers::sqrt2 * std::max(limits.max_accel_mps2, limits.stop_decel_mps2) +
         lever_m * limits.max_turn_accel_radps2;
}

}  // namespace

// Profile ramps are twice as steep as anything the loop asks for: a wheel then follows the loop's ramp and not its own.
// A drive in cyclic velocity does without; in profile velocity it must grant at least what the loop asks for. The quick
// stop must be as steep as was said, within a tenth that its units may round away.
void add_ramp_steps(StartupSteps& steps, const Robot& robot, const DriveParameters& drive) noexcept {
  const double steepest = steepest_command_mps2(robot);
  const std::uint32_t wished = ramp_units(robot, drive, 2.0 * steepest);
  const std::uint32_t least = ramp_units(robot, drive, steepest);
  const std::uint32_t quick_stop = ramp_units(robot, drive, robot.limits.quick_stop_mps2);
  const auto write = [&steps](const char* name, ObjectAddress object, std::uint32_t value) {
    add(steps, {.name = name, .object = object, .bytes = 4, .value = value, .may_refuse = true});
  };
  const auto judge = [&steps](const char* name, ObjectAddress object, std::uint32_t lowest, StepMode mode) {
    add(steps, {.name = name,
                .action = StepAction::kVerifyRange,
                .object = object,
                .bytes = 4,
                .value = lowest,
                .may_be_missing = true,
                .mode = mode});
  };
  write("profile acceleration 6083h", object::kProfileAcceleration, wished);
  judge("profile acceleration 6083h in force: at least what the loop asks for", object::kProfileAcceleration, least,
        StepMode::kProfileVelocity);
  write("profile deceleration 6084h", object::kProfileDeceleration, wished);
  judge("profile deceleration 6084h in force: at least what the loop asks for", object::kProfileDeceleration, least,
        StepMode::kProfileVelocity);
  write("quick stop deceleration 6085h", object::kQuickStopDeceleration, quick_stop);
  judge("quick stop deceleration 6085h in force: at least nine tenths of limits.quick_stop_mps2",
        object::kQuickStopDeceleration, quick_stop - quick_stop / 10, StepMode::kAny);
}

}  // namespace ivo::drivers
