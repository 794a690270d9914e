// One step ahead: the agent whose path ends earliest goes to the neighbour that shows the most new mass a second.
#pragma once

#include "firmware/tools/bench/rivals/team_walk.hpp"

namespace ivo::firmware::rivals {

/// Makes one plan, whatever the effort.
[[nodiscard]] RivalPlan plan_greedily(const RivalProblem& problem, Effort effort, std::uint64_t seed);

/// The edge with the most new mass a second, -1 when none shows anything new. Cost: the node's edges, their rows.
[[nodiscard]] planner::Edge best_edge(const RivalProblem& problem, const TeamWalk& walk, int agent);

}  // namespace ivo::firmware::rivals
