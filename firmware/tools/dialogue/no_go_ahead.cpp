#include "firmware/tools/dialogue/no_go_ahead.hpp"

#include <cmath>
#include <cstddef>
#include <span>

#include "planner/world/polygon.hpp"

namespace ivo::firmware {
namespace {

planner::Area area_of(const console::DrawnArea& drawn) {
  planner::Area area;
  for (std::size_t i = 0; i < drawn.corners; ++i) {
    (void)area.push_back({drawn.corner[i].x_m, drawn.corner[i].y_m});
  }
  return area;
}

bool touches_ahead(std::span<const Point> way, double behind_m, const planner::Area& area) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    Point a = way[i - 1];
    const Point b = way[i];
    const double leg_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    if (behind_m >= leg_m) {
      behind_m -= leg_m;
      continue;
    }
    a = {a.x_m + (b.x_m - a.x_m) * behind_m / leg_m, a.y_m + (b.y_m - a.y_m) * behind_m / leg_m};
    behind_m = 0.0;
    if (planner::touches(area, a, b)) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool leads_into_no_go(const planner::AgentPath& path, double left_m, const console::AreaBoard& board,
                      std::uint8_t agent) {
  const double behind_m = path.length_m > left_m ? path.length_m - left_m : 0.0;
  for (const auto& drawn : board.slots()) {
    const bool closed = drawn && drawn->purpose == console::AreaPurpose::kNoGo &&
                        (drawn->agent == agent || drawn->agent == console::AreaCommand::kEverybody);
    if (closed && touches_ahead(path.waypoints.span(), behind_m, area_of(*drawn))) {
      return true;
    }
  }
  return false;
}

}  // namespace ivo::firmware
