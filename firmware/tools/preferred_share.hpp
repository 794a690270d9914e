// How much of a path lies where somebody would rather search (the paper's CA, by length).
#pragma once

#include <span>

#include "config/base/geometry.hpp"
#include "planner/world/polygon.hpp"

namespace ivo::firmware {

/// Of the first `length_m` of `way`, the share inside any of `areas`; 0 for a path of no length. Exact: segments are
/// cut where they cross a border. Cost: segments times the areas' vertices, squared at worst.
[[nodiscard]] double share_inside(std::span<const Point> way, double length_m, const planner::Areas& areas);

}  // namespace ivo::firmware
