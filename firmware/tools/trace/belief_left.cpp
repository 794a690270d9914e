#include "firmware/tools/trace/belief_left.hpp"

#include <algorithm>
#include <cmath>

#include "planner/world/visibility.hpp"

namespace ivo::firmware {
namespace {

constexpr double kLookEveryM = 0.1;

}  // namespace

BeliefLeft::BeliefLeft(const planner::Planner& planner)
    : cells_(std::make_unique<planner::Cells>(planner.cells())), mass_(static_cast<std::size_t>(cells_->count())) {
  for (const planner::Cell cell : planner.belief().cells_with_mass()) {
    const auto i = static_cast<std::size_t>(cell);
    mass_[i] = static_cast<float>(static_cast<double>(planner.belief().mass[i]));
  }
}

void BeliefLeft::look(Point place, double sight_radius_m) {
  planner::for_each_seen(*cells_, place, sight_radius_m,
                         [&](planner::Cell cell) { mass_[static_cast<std::size_t>(cell)] = 0.0F; });
}

void BeliefLeft::look_along(std::span<const Point> waypoints, double moved_m, double sight_radius_m) {
  for (std::size_t i = 1; i < waypoints.size() && moved_m > 0.0; ++i) {
    const Point from = waypoints[i - 1];
    const Point to = waypoints[i];
    const double length_m = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    const double gone_m = std::min(length_m, moved_m);
    const int looks = static_cast<int>(gone_m / kLookEveryM) + 1;
    for (int k = 0; k <= looks; ++k) {
      const double part = length_m > 0.0 ? gone_m / length_m * k / looks : 0.0;
      look({from.x_m + part * (to.x_m - from.x_m), from.y_m + part * (to.y_m - from.y_m)}, sight_radius_m);
    }
    moved_m -= length_m;
  }
}

}  // namespace ivo::firmware
