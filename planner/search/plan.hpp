// What the planner hands out: a path for each agent, and what the team can expect of them.
#pragma once

#include "config/base/geometry.hpp"
#include "config/base/static_vector.hpp"
#include "config/limits.hpp"

namespace ivo::planner {

/// A path ends where its agent last sees something new (model.md, "Sensing and expected time"): the last waypoint need
/// not be a node. A path that is full ends there, whatever is left: the plan is then incomplete and says so.
struct AgentPath {
  StaticVector<Point, limits::kWaypoints> waypoints;  ///< the first is the agent's start
  double length_m = 0.0;
  double duration_s = 0.0;  ///< length over the speed the planner assumed
};

/// All on the mission's prior, normalised over the observable cells, but the sub-prior time, which is on the
/// sub-priors.
struct PlanScore {
  double expected_time_s = 0.0;             ///< ET, Eq. 8, steps of 1 s
  double expected_time_continuous_s = 0.0;  ///< ET_c: the integral of 1 - P(t) over [0, T]
  double expected_sub_prior_time_s = 0.0;   ///< EST, Eq. 10, team reading, of the first K steps; 0 without sub-priors
  double expected_sub_prior_time_own_s = 0.0;  ///< EST, own reading; 0 without sub-priors, and where not asked for
  double unseen_mass = 1.0;                    ///< 1 - P(T)
  double horizon_s = 0.0;                      ///< T, the end of the last path
  bool complete = false;                       ///< unseen mass at or below the mission's limit
};

struct Plan {
  StaticVector<AgentPath, limits::kAgents> paths;
  PlanScore score;
};

}  // namespace ivo::planner
