// A DBC that names every frame on a robot's bus and every quantity in it, for tools that know CAN and not CANopen.
#pragma once

#include <string>

#include "config/robot.hpp"

namespace ivo::firmware {

/// bus_messages(robot) in the form of Vector's DBC. Same robot, same bytes.
[[nodiscard]] std::string dbc_text(const Robot& robot);

}  // namespace ivo::firmware
