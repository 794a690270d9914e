// The cells of swaths, one by one.
#pragma once

#include "planner/world/sight_table.hpp"

namespace ivo::test {

/// Calls `on_cell(cell, swath)` for each cell of each swath, in the order of the way; a cell may come in several.
template <class OnCell>
void for_each_cell(const planner::Cells& cells, const planner::SightTable& sight, const planner::SightView& view,
                   OnCell&& on_cell) {
  for (std::size_t i = 0; i < view.size(); ++i) {
    const planner::Swath& swath = view.at(i);
    for (int row = 0; row < swath.rows; ++row) {
      planner::for_each_bit(sight.words(swath)[row], [&](int bit) {
        on_cell(cells.at(8 * swath.first_byte + bit, swath.first_row + row), swath);
      });
    }
  }
}

}  // namespace ivo::test
