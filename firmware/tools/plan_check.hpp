// Whether a plan of any origin can be followed: by the mission's agents, from their starts, over free ground.
#pragma once

#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "firmware/files/plan_file.hpp"
#include "firmware/tools/planner_setup.hpp"

namespace ivo::firmware {

/// Waypoints by agent, in the mission's order. Refuses, by agent and waypoint: agents that are unknown, missing or
/// twice there, more waypoints than this build's capacity, a first waypoint more than 1 cm from the start, and a
/// segment on which the agent's footprint leaves the map, meets an obstacle or a class that it may not enter, or that
/// touches a restricted area: the rule of the graph's edges. `path` is the file's, for the complaint. Cost: a
/// swept-disc test a segment.
[[nodiscard]] Result<std::vector<std::vector<Point>>> check_paths(const std::string& path,
                                                                  const std::vector<ForeignPath>& paths,
                                                                  const MissionInputs& inputs);

}  // namespace ivo::firmware
