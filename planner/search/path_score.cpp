#include "planner/search/path_score.hpp"

#include <cmath>

#include "planner/numeric/index.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::planner {
namespace {

double distance_m(Point a, Point b) noexcept {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

double length_m(std::span<const Point> waypoints) noexcept {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    sum_m += distance_m(waypoints[i - 1], waypoints[i]);
  }
  return sum_m;
}

void PathScorer::look(const Cells& cells, const Belief& belief, int agent, double radius_m, Point from,
                      double time_s) noexcept {
  for_each_seen(cells, from, radius_m, [&](Cell c) {
    if (belief.mass[index(c)] > 0.0) {
      (void)sightings_.see(c, agent, time_s);
    }
  });
}

void PathScorer::look_along(const Cells& cells, const Belief& belief, int agent, const WaypointPath& path) noexcept {
  double time_s = 0.0;
  for (std::size_t i = 0; i < path.waypoints.size(); ++i) {
    const Point to = path.waypoints[i];
    if (i == 0) {
      look(cells, belief, agent, path.sight_radius_m, to, 0.0);
      continue;
    }
    const Point from = path.waypoints[i - 1];
    const double length = distance_m(from, to);
    const int points = sight_points(length, cells.cell_m());
    const double point_s = length / path.speed_mps / points;
    for (int k = 1; k <= points; ++k) {
      look(cells, belief, agent, path.sight_radius_m, sight_point(from, to, k, points), time_s + k * point_s);
    }
    time_s += points * point_s;  // of the last sight point to the last bit
  }
}

PlanScore PathScorer::score(const Cells& cells, const Belief& belief, std::span<const WaypointPath> paths,
                            double max_unseen_mass) noexcept {
  sightings_.clear();
  for (std::size_t m = 0; m < paths.size(); ++m) {
    look_along(cells, belief, static_cast<int>(m), paths[m]);
  }
  expected_.clear();
  expected_.add(belief, sightings_, 0, belief.mass_cell_count);
  return expected_.score(belief, max_unseen_mass);
}

}  // namespace ivo::planner
