// Monte Carlo tree search over the team's moves (UCT, Kocsis and Szepesvari 2006, as the single-player variant of
// Schadd et al. 2008): agents move in turn, the one whose path ends earliest first; a node's children are its most
// promising moves; rollouts are greedy with noise to the end of the plan, so that every try is a whole plan. The root
// moves along the best plan found, and starts over when that is at its end.
#pragma once

#include "firmware/tools/bench/rivals/rivals.hpp"

namespace ivo::firmware::rivals {

[[nodiscard]] RivalPlan plan_by_rollouts(const RivalProblem& problem, Effort effort, std::uint64_t seed);

}  // namespace ivo::firmware::rivals
