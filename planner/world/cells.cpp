#include "planner/world/cells.hpp"

#include <algorithm>
#include <cmath>

#include "planner/world/seen_map.hpp"

namespace ivo::planner {
namespace {

struct PixelRange {
  int first = 0;
  int last = -1;  // inclusive
};

// Pixels whose centres lie in [low_m, high_m); the pixel under the middle when there is none.
PixelRange pixels_of(double low_m, double high_m, double resolution_m, int pixels) noexcept {
  constexpr double kTie =
      1e-9;  // a centre on the line between two cells belongs to the upper one, whatever the rounding
  const int first = static_cast<int>(std::ceil(low_m / resolution_m - 0.5 - kTie));
  const int last = static_cast<int>(std::ceil(high_m / resolution_m - 0.5 - kTie)) - 1;
  if (first <= last && first < pixels) {
    return {std::max(first, 0), std::min(last, pixels - 1)};
  }
  const int middle = static_cast<int>(0.5 * (low_m + high_m) / resolution_m);
  const int clamped = std::clamp(middle, 0, pixels - 1);
  return {clamped, clamped};
}

SemanticClass majority(const SegmentedMap& map, PixelRange columns, PixelRange rows) noexcept {
  std::array<int, kClasses> votes{};
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      ++votes[static_cast<std::size_t>(map.at(x, y))];
    }
  }
  return static_cast<SemanticClass>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

}  // namespace

Refusal Cells::build(const SegmentedMap& map, double cell_m) noexcept {
  constexpr double kWhole = 1e-9;  // 40 m / 0.25 m is 160 cells, whatever the rounding
  const double columns = std::ceil(map.width_m() / cell_m - kWhole);
  const double rows = std::ceil(map.height_m() / cell_m - kWhole);
  // On a narrow map windows of 64 columns hang over the ends of the rows (seen_map.hpp).
  const double taken =
      rows * (columns < 64.0 ? std::max(columns, 4.0 * SeenMap::stride_of(static_cast<int>(columns))) : columns);
  if (taken > limits::kCells) {
    return {.code = RefusalCode::kTooManyCells, .value = taken, .limit = limits::kCells};
  }
  columns_ = static_cast<int>(columns);
  rows_ = static_cast<int>(rows);
  cell_m_ = cell_m;
  for (int row = 0; row < rows_; ++row) {
    const PixelRange y = pixels_of(row * cell_m, (row + 1) * cell_m, map.resolution_m, map.height_px);
    for (int column = 0; column < columns_; ++column) {
      const PixelRange x = pixels_of(column * cell_m, (column + 1) * cell_m, map.resolution_m, map.width_px);
      const ClassProperties& properties = map.properties(majority(map, x, y));
      flags_[index(at(column, row))] =
          static_cast<std::uint8_t>((properties.obstacle ? kObstacle : 0) | (properties.occluder ? kOccluder : 0));
      occluder_sums_[index(at(column, row))] =
          (properties.occluder ? 1 : 0) + sum_at(column, row + 1) + sum_at(column + 1, row) - sum_at(column, row);
    }
  }
  return {};
}

}  // namespace ivo::planner
