// A turning wheel in words.
#pragma once

#include <string>

#include "config/robot.hpp"
#include "firmware/tools/wheels/wheel_turner.hpp"

namespace ivo::firmware::wheels {

/// "front left (node 1)"
[[nodiscard]] std::string wheel_text(const Robot& robot, Wheel wheel);
/// What is going on now, and which key does what.
[[nodiscard]] std::string status_text(const TurnStatus& status);
/// What stopped the wheel, and what may be the cause; empty for no note.
[[nodiscard]] std::string note_text(const TurnMeasure::Result& turned, Wheel wheel);
/// "1.02 turns, 4178 counts; told +0.50 rad/s, turned +0.51 (+2.0 %)"
[[nodiscard]] std::string measured_text(const TurnMeasure::Result& turned);
/// The fault of a drive with what its emergency means.
[[nodiscard]] std::string fault_text(const drivers::DriveFault& fault);

}  // namespace ivo::firmware::wheels
