#include "firmware/tools/bench/rivals/completion.hpp"

#include <cmath>

#include "firmware/tools/bench/rivals/free_ways.hpp"
#include "firmware/tools/bench/rivals/rival_score.hpp"
#include "firmware/tools/bench/rivals/team_walk.hpp"

namespace ivo::firmware::rivals {

Waypoints completed(const RivalProblem& problem, const Waypoints& waypoints) {
  Seen seen = look_along(problem, waypoints, 1);
  if (planner::is_complete(seen.unseen_mass, problem.search.colony.ant.max_unseen_mass)) {
    return waypoints;
  }
  std::vector<planner::Node> at;
  for (std::size_t m = 0; m < waypoints.size(); ++m) {
    const Point end = waypoints[m].back();
    const std::optional<planner::Node> node = FreeWays(problem, static_cast<int>(m)).node_near(end);
    at.push_back(node.value_or(-1));
    if (node) {
      const Point there = problem.prepared.graph().position(*node);
      seen.times_s[m] += std::hypot(there.x_m - end.x_m, there.y_m - end.y_m) / problem.search.agents[m].speed_mps;
    }
  }
  TeamWalk walk(problem);
  walk.resume(std::move(seen.cells), at, seen.times_s);
  walk.finish();
  const Waypoints rest = walk.waypoints();
  Waypoints all = waypoints;
  for (std::size_t m = 0; m < all.size(); ++m) {
    if (rest[m].size() > 1) {  // its first is the agent's start
      all[m].push_back(problem.prepared.graph().position(at[m]));
      all[m].insert(all[m].end(), rest[m].begin() + 1, rest[m].end());
    }
  }
  return all;
}

}  // namespace ivo::firmware::rivals
