// The disc of cells within an agent's sight radius, row by row: |c - x|^2 <= R^2 + 1e-9 to the last bit of
// within_radius() (model.md, "Sensing and expected time").
#pragma once

#include <algorithm>
#include <cmath>

#include "planner/world/cells.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::planner {

class SightDisc {
 public:
  /// Columns, both included; empty when first > last.
  struct Run {
    int first = 0;
    int last = -1;
  };

  SightDisc(const Cells& cells, Point from, double radius_m) noexcept
      : cells_(cells), from_(from), radius_m_(radius_m) {
    const double size = cells.cell_m();
    first_row_ = std::max(0, static_cast<int>((from.y_m - radius_m) / size) - 1);
    last_row_ = std::min(cells.rows() - 1, static_cast<int>((from.y_m + radius_m) / size) + 1);
    const int first_column = std::max(0, static_cast<int>((from.x_m - radius_m) / size) - 1);
    const int last_column = std::min(cells.columns() - 1, static_cast<int>((from.x_m + radius_m) / size) + 1);
    open_ = first_column > last_column || first_row_ > last_row_ ||
            !cells.any_occluder({first_column, first_row_, last_column, last_row_});
  }

  [[nodiscard]] int first_row() const noexcept { return first_row_; }
  [[nodiscard]] int last_row() const noexcept { return last_row_; }
  /// Nothing near can hide anything: within the radius is seen.
  [[nodiscard]] bool open() const noexcept { return open_; }

  /// Cells of a row within the radius. Cost: a square root.
  [[nodiscard]] Run run(int row) const noexcept {
    const double dy = (row + 0.5) * cells_.cell_m() - from_.y_m;
    const double left = radius_m_ * radius_m_ + 1e-9 - dy * dy;
    if (left < 0.0) {
      return {};
    }
    const double half = std::sqrt(left);
    const double size = cells_.cell_m();
    Run run{std::max(0, static_cast<int>((from_.x_m - half) / size)),
            std::min(cells_.columns() - 1, static_cast<int>((from_.x_m + half) / size))};
    // The quotient may be off by one either way; the rule decides.
    while (run.first <= run.last && !within(run.first, row)) {
      ++run.first;
    }
    while (run.first > 0 && within(run.first - 1, row)) {
      --run.first;
    }
    while (run.last >= run.first && !within(run.last, row)) {
      --run.last;
    }
    while (run.last + 1 < cells_.columns() && run.last >= run.first && within(run.last + 1, row)) {
      ++run.last;
    }
    return run;
  }

 private:
  [[nodiscard]] bool within(int column, int row) const noexcept {
    return within_radius(cells_, from_, column, row, radius_m_);
  }

  const Cells& cells_;
  Point from_;
  double radius_m_;
  int first_row_ = 0;
  int last_row_ = -1;
  bool open_ = false;
};

}  // namespace ivo::planner
