// What has been searched so far: the cells that somebody who looks for the object has had in sight.
#pragma once

#include <array>
#include <cstdint>

#include "config/base/geometry.hpp"
#include "planner/numeric/index.hpp"
#include "planner/search/belief.hpp"
#include "planner/world/cell_set.hpp"
#include "planner/world/cells.hpp"

namespace ivo::firmware {

/// Outside of the loop. 4.2 MB with room for a million cells; no heap.
class SearchedMap {
 public:
  /// The map, and how probable each cell is, which is copied: 4 bytes a cell.
  SearchedMap(const planner::Cells& cells, const planner::Belief& belief) noexcept;

  /// Somebody at `from` sees everything within `radius_m` that nothing hides. Nothing when there is no such place on
  /// the map. Cost: a line of sight a cell of the disc.
  void look(const planner::Cells& cells, Point from, double radius_m) noexcept;

  [[nodiscard]] const planner::CellSet& cells() const noexcept { return searched_; }
  /// Probability of one, searched or not, as it was before anybody searched.
  [[nodiscard]] double share(planner::Cell c) const noexcept { return static_cast<double>(share_[planner::index(c)]); }
  /// Probability of them, 0 to 1.
  [[nodiscard]] double mass() const noexcept { return mass_; }
  /// Grows with each new cell.
  [[nodiscard]] std::uint32_t count() const noexcept { return count_; }

 private:
  std::array<float, limits::kCells> share_{};
  planner::CellSet searched_;
  double mass_ = 0.0;
  std::uint32_t count_ = 0;
};

}  // namespace ivo::firmware
