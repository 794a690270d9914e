// Where the node of a square goes (paper, "Problem Formulation"; model.md, "Graph").
#pragma once

#include <optional>

#include "planner/world/collision.hpp"

namespace ivo::planner {

struct Square {
  double min_x_m, min_y_m, max_x_m, max_y_m;
};

/// The square's centre when every obstacle is `clearance_m` away; else the centroid of its free area, if that is clear;
/// else the clear corner nearest to that centroid (ties: lower, then left); else nothing. Cost: the square's pixels.
[[nodiscard]] std::optional<Point> place_node(const SegmentedMap& map, const Square& square,
                                              double clearance_m) noexcept;

}  // namespace ivo::planner
