#include "firmware/mission/searched_map.hpp"

#include "planner/numeric/index.hpp"
#include "planner/numeric/scalar.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::firmware {

using planner::Cell;
using planner::index;

SearchedMap::SearchedMap(const planner::Cells& cells, const planner::Belief& belief) noexcept {
  for (Cell c = 0; c < cells.count(); ++c) {
    share_[index(c)] = static_cast<float>(planner::to_double(belief.mass[index(c)]));
  }
}

void SearchedMap::look(const planner::Cells& cells, Point from, double radius_m) noexcept {
  const double width_m = cells.columns() * cells.cell_m();
  const double height_m = cells.rows() * cells.cell_m();
  if (!(from.x_m >= 0 && from.y_m >= 0 && from.x_m < width_m && from.y_m < height_m)) {
    return;
  }
  planner::for_each_seen(cells, from, radius_m, [&](Cell c) {
    if (searched_.insert(c)) {
      mass_ += static_cast<double>(share_[index(c)]);
      ++count_;
    }
  });
}

}  // namespace ivo::firmware
