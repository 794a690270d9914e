#include "firmware/tools/bench/rivals/greedy_planner.hpp"

#include "firmware/tools/bench/rivals/best_plan.hpp"

namespace ivo::firmware::rivals {

planner::Edge best_edge(const RivalProblem& problem, const TeamWalk& walk, int agent) {
  const planner::Graph& graph = problem.prepared.graph();
  const planner::Node here = walk.at(agent);
  planner::Edge best = -1;
  double best_rate = 1e-15;
  for (planner::Edge e = graph.first_edge(here); e < graph.end_edge(here); ++e) {
    if (!walk.open(agent, e)) {
      continue;
    }
    if (const double rate = walk.rate(agent, e); rate > best_rate) {
      best_rate = rate;
      best = e;
    }
  }
  return best;
}

RivalPlan plan_greedily(const RivalProblem& problem, Effort /*effort*/, std::uint64_t /*seed*/) {
  TeamWalk walk(problem);
  while (const std::optional<int> agent = walk.next_agent()) {
    if (const planner::Edge e = best_edge(problem, walk, *agent); e >= 0) {
      walk.take(*agent, e);
    } else {
      walk.jump(*agent);
    }
  }
  BestPlan best(problem);
  best.offer(walk.waypoints(), false);
  return best.take(1);
}

}  // namespace ivo::firmware::rivals
