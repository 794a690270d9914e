// Back and forth along parallel lanes a sensor's width apart. Neighbouring lanes go to one agent, in shares by what it
// sweeps a second; between lanes and around obstacles it goes straight or over the graph. Within its time it tries both
// directions, widths and offsets of the lanes, where they end, and either end of each agent's share first, and keeps
// the best.
#pragma once

#include "firmware/tools/bench/rivals/rivals.hpp"

namespace ivo::firmware::rivals {

[[nodiscard]] RivalPlan plan_like_a_lawnmower(const RivalProblem& problem, Effort effort, std::uint64_t seed);

}  // namespace ivo::firmware::rivals
