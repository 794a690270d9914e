#include "firmware/tools/bench/rivals/rival_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/search/expected_time.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::firmware::rivals {

Seen look_along(const RivalProblem& problem, const Waypoints& waypoints, int stride) {
  using planner::Cell;
  using planner::index;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const planner::Cells& cells = problem.prepared.cells();
  std::vector<double> first_s(index(cells.count()), kNever);
  Seen seen{CellSet(problem.coverage.words(), 0), std::vector<double>(waypoints.size(), 0.0), {}};
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
  double mass_steps = 0.0;
  double found = 0.0;
  for (const Cell c : problem.prepared.belief().cells_with_mass()) {
    const double at_s = first_s[index(c)];
    if (at_s == kNever) {
      continue;
    }
    const double mass = problem.prepared.belief().mass[index(c)];
    seen.cells[index(c) / 64] |= std::uint64_t{1} << (index(c) % 64);
    found += mass;
    mass_seconds += mass * at_s;
    mass_steps += mass * (std::max(planner::step_of(at_s), 1) - 1);
    seen.score.horizon_s = std::max(seen.score.horizon_s, at_s);
  }
  seen.score.unseen_mass = std::max(0.0, 1.0 - found);
  seen.score.complete = planner::is_complete(seen.score.unseen_mass, problem.search.colony.ant.max_unseen_mass);
  seen.score.expected_time_continuous_s = mass_seconds + seen.score.unseen_mass * seen.score.horizon_s;
  seen.score.expected_time_s = mass_steps + seen.score.unseen_mass * planner::step_of(seen.score.horizon_s);
  return seen;
}

planner::PlanScore score(const RivalProblem& problem, const Waypoints& waypoints) {
  return look_along(problem, waypoints, 1).score;
}

}  // namespace ivo::firmware::rivals
