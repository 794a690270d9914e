// A few moves ahead, replanned after each: the agent whose path ends earliest takes the first move of the sequence of
// `depth` moves that finds the most, what is found later counting less: sum of p exp(-t / tau). Within its time it
// makes plans with different tau, then looks deeper, and keeps the best.
#pragma once

#include "firmware/tools/bench/rivals/rivals.hpp"

namespace ivo::firmware::rivals {

[[nodiscard]] RivalPlan plan_with_receding_horizon(const RivalProblem& problem, Effort effort, std::uint64_t seed);

}  // namespace ivo::firmware::rivals
