// The steps of start-up that set up a drive's PDOs.
#pragma once

#include "config/robot.hpp"
#include "drivers/startup_steps.hpp"

namespace ivo::drivers {

/// Appends: RPDO1 (and RPDO2 with the shared targets), TPDO1, every value read back; then all other TPDOs invalid,
/// because what they would send by themselves is not in the bus's budget. Every PDO acts at every SYNC.
void add_pdo_steps(StartupSteps& steps, const Robot& robot, Wheel wheel) noexcept;

}  // namespace ivo::drivers
