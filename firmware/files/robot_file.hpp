// Robot files: config/robots/*.toml into config/robot.hpp.
#pragma once

#include <string>

#include "config/base/result.hpp"
#include "config/robot.hpp"

namespace ivo::firmware {

/// Tables [base], [limits], [bus] and [drive.front_left], [drive.front_right], [drive.rear_left], [drive.rear_right],
/// as config/robots/ivo.toml shows. Refuses, by file, line and key: what is missing, unknown, of the wrong type or out
/// of range; node-ids that are shared; a stop ramp gentler than ordinary braking; an EDS (its path is from the robot
/// file's folder) that cannot be read or lacks what start-up will read and write.
[[nodiscard]] Result<Robot> read_robot(const std::string& path);

}  // namespace ivo::firmware
