// From a mission and its world to the loop's setup.
#pragma once

#include "firmware/loop/control_loop.hpp"
#include "firmware/mission/search_object.hpp"
#include "firmware/tools/planner_setup.hpp"
#include "firmware/tools/run_world.hpp"

namespace ivo::firmware {

/// Where the mission says that the object is; `planner` is prepared.
[[nodiscard]] SearchObject object_of(const Mission& mission, const planner::Planner& planner);

/// Without `fault_waits` and `tracer`, which are for who runs the loop to decide. `world` outlives the loop.
[[nodiscard]] LoopSetup loop_setup(const MissionInputs& inputs, const SearchObject& object, RunWorld& world);

}  // namespace ivo::firmware
