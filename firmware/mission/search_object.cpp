#include "firmware/mission/search_object.hpp"

#include <algorithm>

#include "planner/numeric/rng.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::firmware {
namespace {

constexpr std::uint64_t kObjectStream =
    0x6F626A656374;  // keeps the object apart from what the planner draws of the same seed

}  // namespace

SearchObject SearchObject::drawn(const planner::Cells& cells, const planner::Belief& belief, std::uint64_t seed,
                                 FindRule rule) noexcept {
  planner::Rng rng(seed ^ kObjectStream);
  const double draw = rng.unit();
  double sum = 0.0;
  planner::Cell place = 0;
  for (const planner::Cell c : belief.cells_with_mass()) {
    place = c;
    sum += belief.mass[static_cast<std::size_t>(c)];
    if (sum > draw) {
      break;
    }
  }
  return {cells.centre(place), rule};
}

bool SearchObject::found_from(const planner::Cells& cells, Point from, double radius_m) const noexcept {
  if (!place_) {
    return false;
  }
  const double dx = place_->x_m - from.x_m;
  const double dy = place_->y_m - from.y_m;
  if (dx * dx + dy * dy > radius_m * radius_m) {
    return false;
  }
  if (rule_ == FindRule::kDistance) {
    return true;
  }
  const double extent_x = cells.columns() * cells.cell_m();
  const double extent_y = cells.rows() * cells.cell_m();
  const Point on_grid{std::clamp(from.x_m, 0.0, extent_x), std::clamp(from.y_m, 0.0, extent_y)};
  const int column = std::min(cells.columns() - 1, static_cast<int>(place_->x_m / cells.cell_m()));
  const int row = std::min(cells.rows() - 1, static_cast<int>(place_->y_m / cells.cell_m()));
  return planner::line_of_sight(cells, on_grid, cells.at(column, row));
}

}  // namespace ivo::firmware
