// What a rival's waypoints are worth, at the sight points of model.md ("Sensing and expected time").
#pragma once

#include "firmware/tools/bench/rivals/rivals.hpp"

namespace ivo::firmware::rivals {

/// ET, ET_c, unseen mass, horizon, complete; no EST. Cost: the sight points times the disc.
[[nodiscard]] planner::PlanScore score(const RivalProblem& problem, const Waypoints& waypoints);

/// What the paths show, from every `stride`-th sight point and the ends of each move.
struct Seen {
  CellSet cells;
  std::vector<double> times_s;  ///< when each path ends
  planner::PlanScore score;     ///< as above when the stride is 1
};
[[nodiscard]] Seen look_along(const RivalProblem& problem, const Waypoints& waypoints, int stride);

}  // namespace ivo::firmware::rivals
