#include "planner/search/way_field.hpp"

#include <algorithm>
#include <cmath>

#include "planner/search/open_buckets.hpp"

namespace ivo::planner {
namespace {

constexpr double kOctileOverLength = 1.0823922002923940;  // sqrt(4 - 2 sqrt(2))
constexpr double kSqrt2 = 1.4142135623730951;
// Of the proofs that edges are free: libccd may take an overlap of 0.1 mm for a touch (collision.hpp).
constexpr double kTouch_m = 1e-3;

}  // namespace

void WayField::build(const SegmentedMap& map, const Cells& cells, const Walker& walker, CellScratch next,
                     CellScratch previous) noexcept {
  metres_a_step_ = cells.cell_m() / kSide / kOctileOverLength;
  block(map, cells, walker);
  if (any_blocked_) {
    spread(cells, walker.start, next, previous);
  }
}

// The disc's centre keeps the footprint's radius from every blocked pixel. So it keeps a side from a cell's centre that
// lies this far inside what blocks, or this near to it.
void WayField::block(const SegmentedMap& map, const Cells& cells, const Walker& walker) noexcept {
  const auto blocking =
      static_cast<ClassSet>(obstacle_classes(map.classes) | restricted_classes(map.classes, walker.kind));
  const auto open = static_cast<ClassSet>(~blocking);
  const double near_m = walker.footprint_radius_m - kTouch_m - cells.cell_m();
  any_blocked_ = false;
  for (Cell c = 0; c < cells.count(); ++c) {
    const Point centre = cells.centre(c);
    const bool inside = near_m < 0;
    bool blocked = false;
    if (map.contains(centre)) {
      const double limit_m = std::abs(near_m) + kTouch_m;
      blocked = inside ? clearance(map, open, centre, limit_m) >= -near_m
                       : clearance(map, blocking, centre, limit_m) <= near_m;
    }
    steps_[index(c)] = blocked ? kBlocked : kNowhere;
    any_blocked_ = any_blocked_ || blocked;
  }
}

void WayField::spread(const Cells& cells, Point start, CellScratch next, CellScratch previous) noexcept {
  OpenBuckets<kSide> open(next, previous);
  const auto reach = [&](Cell c, Steps steps) {
    Steps& known = steps_[index(c)];
    if (known == kBlocked || steps >= known) {
      return;
    }
    if (known != kNowhere) {
      open.remove(c, known);
    }
    known = steps;
    open.add(c, steps);
  };
  // From 0 on every centre around the start.
  const int column = static_cast<int>(std::floor(start.x_m / cells.cell_m() - 0.5));
  const int row = static_cast<int>(std::floor(start.y_m / cells.cell_m() - 0.5));
  for (int y = std::max(row, 0); y <= std::min(row + 1, cells.rows() - 1); ++y) {
    for (int x = std::max(column, 0); x <= std::min(column + 1, cells.columns() - 1); ++x) {
      reach(cells.at(x, y), 0);
    }
  }
  for (Cell c = open.take(); c >= 0; c = open.take()) {
    const Steps steps = steps_[index(c)];
    const int x = cells.column(c);
    const int y = cells.row(c);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= cells.columns() || y + dy >= cells.rows() || (dx == 0 && dy == 0)) {
          continue;
        }
        const bool diagonal = dx != 0 && dy != 0;
        if (diagonal && steps_[index(cells.at(x + dx, y))] == kBlocked &&
            steps_[index(cells.at(x, y + dy))] == kBlocked) {
          continue;
        }
        reach(cells.at(x + dx, y + dy), steps + (diagonal ? kDiagonal : kSide));
      }
    }
  }
}

// The point that sees lies between four centres, the nearest open one no farther than the square's diagonal from it.
void WayField::nearest_within(const Cells& cells, int row, double radius_m, CellScratch out,
                              CellScratch window) const noexcept {
  const double reach_cells = radius_m / cells.cell_m() + kSqrt2 + 1e-9;
  const int rows = static_cast<int>(std::min<double>(reach_cells, cells.rows()));
  const int columns = cells.columns();
  std::fill_n(out.begin(), columns, kNowhere);
  for (int y = std::max(0, row - rows); y <= std::min(cells.rows() - 1, row + rows); ++y) {
    const double dy = y - row;
    const int half = static_cast<int>(std::min<double>(std::sqrt(reach_cells * reach_cells - dy * dy), columns));
    const Steps* const steps = &steps_[index(cells.at(0, y))];
    // Least of a sliding window: its candidates, ascending in column and value.
    int first = 0;
    int last = 0;
    int taken = 0;
    for (int column = 0; column < columns; ++column) {
      for (; taken <= std::min(column + half, columns - 1); ++taken) {
        while (last > first && steps[window[index(last - 1)]] >= steps[taken]) {
          --last;
        }
        window[index(last++)] = taken;
      }
      while (window[index(first)] < column - half) {
        ++first;
      }
      out[index(column)] = std::min(out[index(column)], steps[window[index(first)]]);
    }
  }
}

}  // namespace ivo::planner
