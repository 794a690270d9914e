// Where the object may be, as the planner sees it: the prior and the sub-priors over the observable cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/numeric/scalar.hpp"
#include "planner/world/cells.hpp"
#include "planner/world/seen_map.hpp"

namespace ivo::planner {

struct Belief {
  int cells = 0;
  int agents = 0;
  bool has_sub_priors = false;
  /// p: sums to `whole` over the observable cells, 0 elsewhere; multiples of kMassUnit, so that sums of them are exact.
  std::array<Mass, limits::kCells> mass{};
  Mass whole =
      Mass(1);  ///< the sum of p: 1 but for the rounding of the cells; nothing is unseen when all of it is seen
  /// p_m: each sums to 1/M (Eq. 10) but for the cells' rounding, all together to sub_whole; set when has_sub_priors.
  std::array<std::array<Mass, limits::kCells>, limits::kAgents> sub_mass{};
  Mass sub_whole = Mass(1);
  Mass alike{};                                   ///< p of every cell with mass when all have the same, else 0
  std::array<Cell, limits::kCells> mass_cells{};  ///< the cells with mass, ascending
  int mass_cell_count = 0;
  /// K of EST: steps of 1 s over which every plan of the mission is summed. What a longer plan finds after them counts
  /// as not found.
  int sub_prior_steps = 0;
  double unobservable_share = 0.0;  ///< of the whole prior; enters nothing else
  SeenMap without_mass;             ///< cells without mass, as if seen: where a search begins

  [[nodiscard]] std::span<const Cell> cells_with_mass() const noexcept {
    return {mass_cells.data(), static_cast<std::size_t>(mass_cell_count)};
  }
};

}  // namespace ivo::planner
