// The map at the sensing resolution: square cells, row by row from the bottom (model.md, "World").
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/refusal.hpp"
#include "planner/world/segmented_map.hpp"

namespace ivo::planner {

using Cell = std::int32_t;

/// Columns and rows, both ends included.
struct CellWindow {
  int first_column = 0;
  int first_row = 0;
  int last_column = -1;
  int last_row = -1;
};

class Cells {
 public:
  /// Resamples `map` to cells of `cell_m`: a cell takes the class of most of its pixels, the lowest on a tie; a cell
  /// without a pixel's centre takes the pixel under its own centre. Cells that the border cuts count whole. Cost: once
  /// over the pixels.
  [[nodiscard]] Refusal build(const SegmentedMap& map, double cell_m) noexcept;

  [[nodiscard]] int columns() const noexcept { return columns_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }
  [[nodiscard]] int count() const noexcept { return columns_ * rows_; }
  [[nodiscard]] double cell_m() const noexcept { return cell_m_; }

  [[nodiscard]] Cell at(int column, int row) const noexcept { return row * columns_ + column; }
  [[nodiscard]] int column(Cell c) const noexcept { return c % columns_; }
  [[nodiscard]] int row(Cell c) const noexcept { return c / columns_; }
  [[nodiscard]] Point centre(int column, int row) const noexcept {
    return {(column + 0.5) * cell_m_, (row + 0.5) * cell_m_};
  }
  [[nodiscard]] Point centre(Cell c) const noexcept { return centre(column(c), row(c)); }

  [[nodiscard]] bool obstacle(Cell c) const noexcept { return (flags_[index(c)] & kObstacle) != 0; }
  [[nodiscard]] bool occluder(Cell c) const noexcept { return (flags_[index(c)] & kOccluder) != 0; }
  /// Cost: four look-ups. The window must lie on the grid.
  [[nodiscard]] bool any_occluder(CellWindow w) const noexcept {
    return sum_at(w.last_column + 1, w.last_row + 1) - sum_at(w.first_column, w.last_row + 1) -
               sum_at(w.last_column + 1, w.first_row) + sum_at(w.first_column, w.first_row) !=
           0;
  }

 private:
  static constexpr std::uint8_t kObstacle = 1;
  static constexpr std::uint8_t kOccluder = 2;
  // Occluders below row `row` and left of column `column`.
  [[nodiscard]] std::int32_t sum_at(int column, int row) const noexcept {
    return column == 0 || row == 0 ? 0 : occluder_sums_[index(at(column - 1, row - 1))];
  }

  int columns_ = 0;
  int rows_ = 0;
  double cell_m_ = 0.0;
  std::array<std::uint8_t, limits::kCells> flags_{};
  std::array<std::int32_t, limits::kCells> occluder_sums_{};  // summed area: how many up to and with this cell
};

}  // namespace ivo::planner
