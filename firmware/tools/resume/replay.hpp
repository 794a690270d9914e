// From the state that was kept last to where the event log ends: at most a second later.
#pragma once

#include "firmware/mission/search_run.hpp"
#include "firmware/tools/resume/kept_search.hpp"
#include "firmware/tools/resume/logged_run.hpp"

namespace ivo::firmware {

/// Brings `kept`, which is planned, up to the last whole line of `log` that is younger than it: tracks, search time,
/// what is left of the robot's path, and whether the search is over. `start`: of the robot.
void replay(const LoggedRun& log, const Searchers& searchers, const Pose& start, KeptSearch& kept);

}  // namespace ivo::firmware
