// What is seen from a point: the circular ideal sensor with occlusion (Eq. 5; model.md, "Sensing and expected time").
#pragma once

#include <algorithm>
#include <cmath>

#include "planner/world/cells.hpp"

namespace ivo::planner {

/// True when no occluding cell lies between `from` and the centre of `target` on the grid walk; the cells of both do
/// not count, and at an exact corner the walk steps in y first. `from` must lie on the grid. Cost: one look-up a cell
/// crossed, as many as are added to `walked`.
[[nodiscard]] bool line_of_sight(const Cells& cells, Point from, Cell target, int& walked) noexcept;
[[nodiscard]] inline bool line_of_sight(const Cells& cells, Point from, Cell target) noexcept {
  int walked = 0;
  return line_of_sight(cells, from, target, walked);
}

/// True when the centre of `target` is within `radius_m` of `from`; the 1e-9 m^2 keep cells on the circle in.
[[nodiscard]] inline bool within_radius(const Cells& cells, Point from, int column, int row, double radius_m) noexcept {
  const Point c = cells.centre(column, row);
  const double dx = c.x_m - from.x_m;
  const double dy = c.y_m - from.y_m;
  return dx * dx + dy * dy <= radius_m * radius_m + 1e-9;
}
[[nodiscard]] inline bool within_radius(const Cells& cells, Point from, Cell target, double radius_m) noexcept {
  return within_radius(cells, from, cells.column(target), cells.row(target), radius_m);
}

/// Calls `seen(cell)` for each cell that is seen from `from`, row by row. Cost: the disc's cells times the walk.
template <class Seen>
void for_each_seen(const Cells& cells, Point from, double radius_m, Seen&& seen) noexcept {
  const double size = cells.cell_m();
  const int first_row = std::max(0, static_cast<int>((from.y_m - radius_m) / size) - 1);
  const int last_row = std::min(cells.rows() - 1, static_cast<int>((from.y_m + radius_m) / size) + 1);
  const int first_column = std::max(0, static_cast<int>((from.x_m - radius_m) / size) - 1);
  const int last_column = std::min(cells.columns() - 1, static_cast<int>((from.x_m + radius_m) / size) + 1);
  const bool open = !cells.any_occluder({first_column, first_row, last_column, last_row});
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const Cell c = cells.at(column, row);
      if (within_radius(cells, from, c, radius_m) && (open || line_of_sight(cells, from, c))) {
        seen(c);
      }
    }
  }
}

/// Sight is taken at the ends of a straight move and at even points between, at most half a cell apart: at points 0 to
/// n.
[[nodiscard]] inline int sight_points(double length_m, double cell_m) noexcept {
  // The margin keeps a move that was cut at one of its own sight points on the same points.
  return std::max(1, static_cast<int>(std::ceil(2.0 * length_m / cell_m - 1e-9)));
}

/// Sight point k of n on the move from `a` to `b`; the same bits in both directions.
[[nodiscard]] inline Point sight_point(Point a, Point b, int k, int n) noexcept {
  const bool swap = b.x_m < a.x_m || (b.x_m == a.x_m && b.y_m < a.y_m);
  const Point from = swap ? b : a;
  const Point to = swap ? a : b;
  const int i = swap ? n - k : k;
  if (i == n) {
    return to;
  }
  const double share = static_cast<double>(i) / n;
  return {from.x_m + (to.x_m - from.x_m) * share, from.y_m + (to.y_m - from.y_m) * share};
}

}  // namespace ivo::planner
