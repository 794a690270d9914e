// The four wheels as files name them.
#pragma once

#include <array>
#include <string_view>

#include "config/robot.hpp"

namespace ivo::firmware {

/// By Wheel.
inline constexpr std::array<std::string_view, kWheels> kWheelKeys = {"front_left", "front_right", "rear_left",
                                                                     "rear_right"};

}  // namespace ivo::firmware
