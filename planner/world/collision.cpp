#include "planner/world/collision.hpp"

#include <algorithm>
#include <cmath>

namespace ivo::planner {
namespace {

double distance_to_interval(double x, double low, double high) noexcept { return std::max({low - x, x - high, 0.0}); }

}  // namespace

ClassSet obstacle_classes(const ClassTable& classes) noexcept {
  unsigned set = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    set |= classes[i].obstacle ? 1U << i : 0U;
  }
  return static_cast<ClassSet>(set);
}

ClassSet restricted_classes(const ClassTable& classes, AgentKind kind) noexcept {
  unsigned set = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    set |= classes[i].restricted[static_cast<std::size_t>(kind)] ? 1U << i : 0U;
  }
  return static_cast<ClassSet>(set);
}

bool inside_border(const SegmentedMap& map, Point p, double margin_m) noexcept {
  constexpr double kRounding = 1e-9;  // a disc that touches the border is inside
  const double margin = margin_m - kRounding;
  return p.x_m >= margin && p.y_m >= margin && p.x_m <= map.width_m() - margin && p.y_m <= map.height_m() - margin;
}

double clearance(const SegmentedMap& map, ClassSet blocked, Point p, double limit_m) noexcept {
  const double border = std::min({p.x_m, p.y_m, map.width_m() - p.x_m, map.height_m() - p.y_m});
  if (border <= 0.0) {
    return 0.0;
  }
  const double size = map.resolution_m;
  double nearest = std::min(border, limit_m);
  const int first_row = std::max(0, static_cast<int>((p.y_m - nearest) / size));
  const int last_row = std::min(map.height_px - 1, static_cast<int>((p.y_m + nearest) / size));
  const int first_column = std::max(0, static_cast<int>((p.x_m - nearest) / size));
  const int last_column = std::min(map.width_px - 1, static_cast<int>((p.x_m + nearest) / size));
  for (int row = first_row; row <= last_row; ++row) {
    const double dy = distance_to_interval(p.y_m, row * size, (row + 1) * size);
    for (int column = first_column; column <= last_column; ++column) {
      if (holds(blocked, map.at(column, row))) {
        const double dx = distance_to_interval(p.x_m, column * size, (column + 1) * size);
        nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy));
      }
    }
  }
  return nearest;
}

}  // namespace ivo::planner
