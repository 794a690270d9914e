#include "planner/world/visibility.hpp"

#include <algorithm>
#include <cstdlib>

namespace ivo::planner {

bool line_of_sight(const Cells& cells, Point from, Cell target, int& walked) noexcept {
  const double u = from.x_m / cells.cell_m();
  const double v = from.y_m / cells.cell_m();
  int column = std::clamp(static_cast<int>(u), 0, cells.columns() - 1);
  int row = std::clamp(static_cast<int>(v), 0, cells.rows() - 1);
  const int target_column = cells.column(target);
  const int target_row = cells.row(target);

  const double du = std::abs(target_column + 0.5 - u);
  const double dv = std::abs(target_row + 0.5 - v);
  const int step_x = target_column > column ? 1 : -1;
  const int step_y = target_row > row ? 1 : -1;
  int left_x = std::abs(target_column - column);
  int left_y = std::abs(target_row - row);
  // Distance in cells to the next line crossed in x and in y; lines are compared by cross product, without a division.
  double to_x = step_x > 0 ? column + 1 - u : u - column;
  double to_y = step_y > 0 ? row + 1 - v : v - row;

  const int all = left_x + left_y;
  while (left_x + left_y > 0) {
    const bool in_y = left_x == 0 || (left_y > 0 && to_y * du <= to_x * dv);
    if (in_y) {
      row += step_y;
      --left_y;
      to_y += 1.0;
    } else {
      column += step_x;
      --left_x;
      to_x += 1.0;
    }
    if (left_x + left_y > 0 && cells.occluder(cells.at(column, row))) {
      walked += all - left_x - left_y;
      return false;
    }
  }
  walked += all;
  return true;
}

}  // namespace ivo::planner
