// Rigid motion in the plane at a constant twist.
#pragma once

#include "config/base/geometry.hpp"

namespace ivo::firmware {

/// The pose reached from `from` when the body-frame `twist` is held for `dt_s` seconds: the exponential of SE(2), exact
/// on straight lines and circles alike. The heading comes back within [-pi, pi]. Cost: three sines or cosines.
[[nodiscard]] Pose advance(const Pose& from, const Twist& twist, double dt_s) noexcept;

}  // namespace ivo::firmware
