// Is the CAN interface the one that the robot needs?
#pragma once

#include <string>

#include "config/robot.hpp"
#include "firmware/tools/doctor/finding.hpp"
#include "hal/linux/interface_facts.hpp"

namespace ivo::firmware::doctor {

/// `interface`: the name that was asked for; empty: none was, and nothing is checked. `answer`: what the kernel says.
[[nodiscard]] Group can_checks(const std::string& interface, const hal::LinkAnswer& answer, const Robot& robot);

/// Whether a socket on it would be of use: it is there, carries CAN, is up and runs at the robot's bit rate.
[[nodiscard]] bool usable(const hal::LinkAnswer& answer, const Robot& robot);

/// Frames that the controller hands over in one cycle at most, heartbeat included.
[[nodiscard]] std::uint32_t frames_at_once(const Robot& robot);

}  // namespace ivo::firmware::doctor
