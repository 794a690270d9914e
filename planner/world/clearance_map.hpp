// How far from any obstacle a place surely is: a lower bound a cell, made once, so that most straight moves off the
// graph are proved free by a few look-ups and only those near something need the exact test (collision.hpp).
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/lattice.hpp"
#include "planner/world/cells.hpp"
#include "planner/world/collision.hpp"

namespace ivo::planner {

class ClearanceMap {
 public:
  /// For pixels of a class in `blocked`. Cost: the pixels, and 21 look-ups a cell.
  void build(const SegmentedMap& map, const Cells& cells, ClassSet blocked) noexcept;

  /// A distance in ticks that no obstacle is nearer than; at most about 10 cells, 0 near an obstacle. The map's border
  /// is not counted.
  [[nodiscard]] int at_least(Spot s) const noexcept {
    const int column = clamp_to(s.x / cell_ticks_, columns_);
    const int row = clamp_to(s.y / cell_ticks_, rows_);
    return ticks_[index(row * columns_ + column)];
  }

  /// True when a disc of `radius` ticks swept from `a` to `b` surely meets no obstacle; false says nothing.
  [[nodiscard]] bool surely_free(Spot a, Spot b, int radius) const noexcept;

 private:
  static constexpr int kReach = 10;  // cells looked at to each side

  [[nodiscard]] static int clamp_to(double value, int count) noexcept {
    const int whole = static_cast<int>(value);
    return whole < 0 ? 0 : whole >= count ? count - 1 : whole;
  }

  int columns_ = 0;
  int rows_ = 0;
  double cell_ticks_ = 1.0;
  std::array<std::uint16_t, limits::kCells> ticks_{};
  std::array<std::uint8_t, limits::kCells> below_{};  // rows to the nearest blocked cell of the column, while building
};

}  // namespace ivo::planner
