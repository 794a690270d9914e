#include "firmware/tools/bench/rivals/rival_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/world/visibility.hpp"

namespace ivo::firmware::rivals {

Seen look_along(const RivalProblem& problem, const Waypoints& waypoints, int stride) {
  using planner::Cell;
  using planner::index;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const planner::Cells& cells = problem.prepared.cells();
  std::vector<double> first_s(index(cells.count()), kNever);
  Seen seen{CellSet(problem.coverage.words(), 0), std::vector<double>(waypoints.size(), 0.0)};
  for (std::size_t m = 0; m < waypoints.size(); ++m) {
    const planner::SearchAgent& agent = problem.search.agents[m];
    double& time_s = seen.times_s[m];
    const auto look = [&](Point from, double at_s) {
      planner::for_each_seen(cells, from, agent.sight_radius_m,
                             [&](Cell c) { first_s[index(c)] = std::min(first_s[index(c)], at_s); });
    };
    look(waypoints[m].front(), 0.0);
    for (std::size_t i = 1; i < waypoints[m].size(); ++i) {
      const Point a = waypoints[m][i - 1];
      const Point b = waypoints[m][i];
      const double length_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
      const int n = planner::sight_points(length_m, cells.cell_m());
      const double pace_s = length_m / (n * agent.speed_mps);
      for (int k = std::min(stride, n); k <= n; k += k == n ? 1 : std::min(stride, n - k)) {
        look(planner::sight_point(a, b, k, n), time_s + pace_s * k);
      }
      time_s += pace_s * n;
    }
  }
  double mass_seconds = 0.0;
  for (const Cell c : problem.prepared.belief().cells_with_mass()) {
    const double at_s = first_s[index(c)];
    if (at_s == kNever) {
      continue;
    }
    const double mass = problem.prepared.belief().mass[index(c)];
    seen.cells[index(c) / 64] |= std::uint64_t{1} << (index(c) % 64);
    seen.unseen_mass -= mass;
    mass_seconds += mass * at_s;
    seen.horizon_s = std::max(seen.horizon_s, at_s);
  }
  seen.unseen_mass = std::max(0.0, seen.unseen_mass);
  seen.expected_time_s = mass_seconds + seen.unseen_mass * seen.horizon_s;
  return seen;
}

planner::PlanScore score(const RivalProblem& problem, const Waypoints& waypoints) {
  StaticVector<planner::WaypointPath, limits::kAgents> paths;
  for (std::size_t m = 0; m < waypoints.size(); ++m) {
    const planner::SearchAgent& agent = problem.search.agents[m];
    (void)paths.push_back({waypoints[m], agent.speed_mps, agent.sight_radius_m});
  }
  return problem.scorer.score(problem.prepared.cells(), problem.prepared.belief(), paths.span(),
                              problem.search.colony.ant.max_unseen_mass);
}

}  // namespace ivo::firmware::rivals
