#include "firmware/motion/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/motion/arc.hpp"

namespace ivo::firmware {

void Odometry::reset(const Pose& pose) noexcept {
  pose_ = pose;
  moved_ = {};
  reference_rad_.reset();
}

bool Odometry::update(const WheelValues& angles_rad) noexcept {
  moved_ = {};
  if (!std::all_of(angles_rad.begin(), angles_rad.end(), [](double angle) { return std::isfinite(angle); })) {
    return false;
  }
  if (reference_rad_) {
    WheelValues turned_rad;
    for (std::size_t i = 0; i < turned_rad.size(); ++i) {
      turned_rad[i] = angles_rad[i] - (*reference_rad_)[i];
    }
    // Angles stand for speeds over one second, so the twist is the displacement.
    moved_ = kinematics_.twist(turned_rad);
    pose_ = advance(pose_, moved_, 1.0);
  }
  reference_rad_ = angles_rad;
  return true;
}

}  // namespace ivo::firmware
