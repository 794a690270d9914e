// The steps of start-up that set a drive's ramps.
#pragma once

#include "config/robot.hpp"
#include "drivers/startup_steps.hpp"

namespace ivo::drivers {

/// Appends: profile acceleration and deceleration (6083h, 6084h), twice as steep as the loop's own steepest ramp at a
/// rim; quick stop deceleration (6085h), limits.quick_stop_mps2 at the rim. A drive may lack them.
void add_ramp_steps(StartupSteps& steps, const Robot& robot, const DriveParameters& drive) noexcept;

}  // namespace ivo::drivers
