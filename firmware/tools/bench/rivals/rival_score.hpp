// What a rival's waypoints are worth.
#pragma once

#include "firmware/tools/bench/rivals/rivals.hpp"

namespace ivo::firmware::rivals {

/// Exactly, as `ivo score` judges any plan. Cost: the sight points times the disc.
[[nodiscard]] planner::PlanScore score(const RivalProblem& problem, const Waypoints& waypoints);

/// What the paths show, from every `stride`-th sight point and the ends of each move.
struct Seen {
  CellSet cells;
  std::vector<double> times_s;  ///< when each path ends
  double unseen_mass = 1.0;
  double expected_time_s = 0.0;  ///< ET_c, later than the exact one by up to the stride
  double horizon_s = 0.0;
};
[[nodiscard]] Seen look_along(const RivalProblem& problem, const Waypoints& waypoints, int stride);

}  // namespace ivo::firmware::rivals
