// How far along its path a person has come, who need not follow it.
#pragma once

#include <span>

#include "config/base/geometry.hpp"

namespace ivo::firmware {

/// The place of the path nearest to `at`, in metres along it, among those from `before_m` less half a metre to
/// kAhead_m beyond it: a path that crosses itself is not cut short. Never less than `before_m`. Cost: the points.
[[nodiscard]] double along_path(std::span<const Point> path, Point at, double before_m) noexcept;

inline constexpr double kAhead_m = 6.0;

}  // namespace ivo::firmware
