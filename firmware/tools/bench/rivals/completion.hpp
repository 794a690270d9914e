// What a plan left unseen, added at its end: every agent in turn goes on to unseen mass (TeamWalk::jump).
#pragma once

#include "firmware/tools/bench/rivals/rivals.hpp"

namespace ivo::firmware::rivals {

/// The plan itself when it is complete, or when nobody can get to anything new.
[[nodiscard]] Waypoints completed(const RivalProblem& problem, const Waypoints& waypoints);

}  // namespace ivo::firmware::rivals
