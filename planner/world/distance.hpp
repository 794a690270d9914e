#pragma once

#include <cmath>

#include "config/base/geometry.hpp"

namespace ivo::planner {

/// By a square root that rounds correctly on every CPU; std::hypot does not promise to.
[[nodiscard]] inline double distance_m(Point a, Point b) noexcept {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace ivo::planner
