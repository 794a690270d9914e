// How far it is at least to everywhere: a lower bound on the way of a disc from its start, around what is on the map.
//
// Octile distance (moves to 8 neighbours at 1 and sqrt(2)) over the cells that are not blocked, over 1.0824 =
// sqrt(4 - 2 sqrt(2)). A cell is blocked when the disc's centre can nowhere come within a cell's side of the cell's
// centre; diagonal moves between two blocked cells are closed. Why this never exceeds the true way: let f be the
// distance at the centres, linear along the sides of the squares between four centres. The way crosses such a square
// only between sides whose ends are both open, and of two points on open sides f differs by no more than their distance
// (adjacent sides: by the bounds on sides and diagonals; opposite sides: the worst pair has a corner, and
// 1 + (sqrt(2) - 1) u <= 1.0824 sqrt(1 + u^2)). So f grows along the way no faster than its length; in the strip beyond
// the outermost centres, along the way's projection.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/world/cells.hpp"
#include "planner/world/collision.hpp"

namespace ivo::planner {

/// A disc and where it starts.
struct Walker {
  Point start;
  AgentKind kind = AgentKind::kRobot;
  double footprint_radius_m = 0.0;
};

class WayField {
 public:
  using CellScratch = std::span<std::int32_t>;  ///< one a cell

  /// Finds the blocked cells and the distances to the others. Restricted areas are left out: they can only lengthen a
  /// way. Cost: the cells, with the pixels near each, and 8 moves each; the scratch is overwritten.
  void build(const SegmentedMap& map, const Cells& cells, const Walker& walker, CellScratch next,
             CellScratch previous) noexcept;

  /// Whether anything is in the way at all; where nothing is, the straight line is the better bound.
  [[nodiscard]] bool any_blocked() const noexcept { return any_blocked_; }

  /// Length in whole steps, so that sums are exact; rounded down in metres.
  using Steps = std::int32_t;
  static constexpr Steps kNowhere = 0x7FFFFFFE;  ///< as far as nothing can get

  /// For each cell of a row: the steps to the nearest point from which the cell's centre can be within `radius_m`, in
  /// `out` by column. Cost: the columns times the rows that the radius spans.
  void nearest_within(const Cells& cells, int row, double radius_m, CellScratch out, CellScratch window) const noexcept;
  [[nodiscard]] double metres(Steps steps) const noexcept { return steps * metres_a_step_; }

 private:
  // Sides and diagonals in the ratio 239 : 169, just below sqrt(2).
  static constexpr Steps kSide = 169;
  static constexpr Steps kDiagonal = 239;
  static constexpr Steps kBlocked = 0x7FFFFFFF;
  static_assert(limits::kCells < kNowhere / kDiagonal);

  void block(const SegmentedMap& map, const Cells& cells, const Walker& walker) noexcept;
  void spread(const Cells& cells, Point start, CellScratch next, CellScratch previous) noexcept;

  bool any_blocked_ = false;
  double metres_a_step_ = 0.0;
  std::array<Steps, limits::kCells> steps_{};
};

}  // namespace ivo::planner
