// Whether a measurement or a sum is a number at all.
#pragma once

#include <cmath>

#include "config/base/geometry.hpp"

namespace ivo::firmware {

[[nodiscard]] inline bool finite(const Pose& pose) noexcept {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.heading_rad);
}

[[nodiscard]] inline bool finite(const Twist& twist) noexcept {
  return std::isfinite(twist.vx_mps) && std::isfinite(twist.vy_mps) && std::isfinite(twist.wz_radps);
}

}  // namespace ivo::firmware
