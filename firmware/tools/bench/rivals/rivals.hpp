// Other planners that `ivo bench compare` sets against ours, each as good as its kind gets. All see the same prepared
// world: the graph, what is seen along its edges, the prior. All minimise ET_c on the mission's prior, at unseen mass
// at or below the mission's limit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware/tools/bench/rivals/coverage.hpp"
#include "firmware/tools/bench/rivals/effort.hpp"
#include "planner/search/path_score.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware::rivals {

/// Views; built before a rival's time begins, as the planner's tables are.
struct RivalProblem {
  const planner::Planner& prepared;  ///< prepared for `search`
  const planner::SearchProblem& search;
  const Coverage& coverage;     ///< of `prepared`
  planner::PathScorer& scorer;  ///< as `ivo score` has it
};

/// Waypoints of each agent, the first its start.
using Waypoints = std::vector<std::vector<Point>>;

struct RivalPlan {
  Waypoints waypoints;
  planner::PlanScore score;
  bool completed_greedily = false;  ///< what the rival itself made was incomplete
  int tries = 0;                    ///< plans that it made and chose from
};

using Rival = RivalPlan (*)(const RivalProblem&, Effort, std::uint64_t seed);

struct NamedRival {
  const char* name;
  Rival plan;
  bool draws;  ///< its plan depends on the seed
};

/// Greedy, receding horizon, lawnmower, rollout tree search.
[[nodiscard]] std::span<const NamedRival> all();

}  // namespace ivo::firmware::rivals
