// Where the object may be, as the planner sees it: the prior and the sub-priors over the observable cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/world/cells.hpp"

namespace ivo::planner {

struct Belief {
  int cells = 0;
  int agents = 0;
  bool has_sub_priors = false;
  std::array<double, limits::kCells> mass{};  ///< p: sums to 1 over the observable cells, 0 elsewhere
  /// p_m: each sums to 1/M (Eq. 10); set when has_sub_priors.
  std::array<std::array<double, limits::kCells>, limits::kAgents> sub_mass{};
  std::array<Cell, limits::kCells> mass_cells{};  ///< the cells with mass, ascending
  int mass_cell_count = 0;
  double sub_prior_steps = 0.0;     ///< K of EST: steps of 1 s over which every plan of the mission is summed
  double unobservable_share = 0.0;  ///< of the whole prior; enters nothing else

  [[nodiscard]] std::span<const Cell> cells_with_mass() const noexcept {
    return {mass_cells.data(), static_cast<std::size_t>(mass_cell_count)};
  }
};

}  // namespace ivo::planner
