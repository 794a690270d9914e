// Where a disc may stand and move, against the map's pixels. The border of the map is an obstacle.
#pragma once

#include <cstdint>

#include "config/base/geometry.hpp"
#include "planner/world/segmented_map.hpp"

namespace ivo::planner {

/// A set of semantic classes, one bit each.
using ClassSet = std::uint16_t;
[[nodiscard]] constexpr bool holds(ClassSet set, SemanticClass c) noexcept {
  return ((set >> static_cast<unsigned>(c)) & 1U) != 0;
}

[[nodiscard]] ClassSet obstacle_classes(const ClassTable& classes) noexcept;
[[nodiscard]] ClassSet restricted_classes(const ClassTable& classes, AgentKind kind) noexcept;

/// Distance in metres from `p` to the nearest pixel of a class in `blocked` or to the border, `limit_m` when it is
/// farther; 0 inside. Exact. Cost: the pixels within `limit_m`.
[[nodiscard]] double clearance(const SegmentedMap& map, ClassSet blocked, Point p, double limit_m) noexcept;

/// True when a disc of `margin_m` at `p` stays inside the border; to touch it is to be inside.
[[nodiscard]] bool inside_border(const SegmentedMap& map, Point p, double margin_m) noexcept;

/// True when a disc of `radius_m` swept along the segment from `a` to `b` overlaps no pixel of a class in `blocked` and
/// stays inside the border; touching is free, and libccd may take an overlap below 0.1 mm for a touch. Judged on the
/// swept disc (a capsule) against runs of pixels; no heap. Not there in a build without libccd. Cost: the pixels in the
/// capsule's bounding box, and a query a run near it.
[[nodiscard]] bool swept_disc_is_free(const SegmentedMap& map, ClassSet blocked, Point a, Point b,
                                      double radius_m) noexcept;

}  // namespace ivo::planner
