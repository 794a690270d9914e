// A search that was cut off, as the loop takes it up again.
#pragma once

#include "config/base/geometry.hpp"
#include "firmware/mission/search_run.hpp"
#include "planner/search/plan.hpp"

namespace ivo::firmware {

struct ResumedSearch {
  planner::Plan plan;    ///< taken over: nothing is planned anew
  int generations = 0;   ///< that it took
  bool started = false;  ///< somebody had agreed and set off; what follows counts only then
  SearchProgress progress;
  Pose robot;                    ///< where it was last known to be
  double distance_left_m = 0.0;  ///< of its path
};

}  // namespace ivo::firmware
