#include "firmware/tools/run_setup.hpp"

#include <variant>

namespace ivo::firmware {

SearchObject object_of(const Mission& mission, const planner::Planner& planner) {
  if (const Point* place = std::get_if<Point>(&mission.object)) {
    return {*place, mission.find};
  }
  if (std::holds_alternative<ObjectDrawn>(mission.object)) {
    return SearchObject::drawn(planner.cells(), planner.belief(), mission.seed, mission.find);
  }
  return {};
}

LoopSetup loop_setup(const MissionInputs& inputs, const SearchObject& object, RunWorld& world) {
  LoopSetup setup{.robot = inputs.robot, .start = {}, .searchers = {}, .object = object};
  for (const AgentSpec& agent : inputs.file.mission.agents) {
    IVO_CONTRACT(setup.searchers.push_back({.kind = agent.kind,
                                            .motion = agent.motion,
                                            .start = agent.start,
                                            .speed_mps = agent.speed_mps,
                                            .sight_radius_m = agent.sight_radius_m}));
  }
  const AgentSpec& robot = inputs.file.mission.agents.front();
  setup.start = {robot.start.x_m, robot.start.y_m, robot.heading_rad};
  setup.inputs = world.inputs();
  setup.stopwatch = &world.stopwatch();
  setup.real_time = world.time() != RunWorld::Time::kSimulated;
  setup.overruns_count_only = world.time() != RunWorld::Time::kReal;
  return setup;
}

}  // namespace ivo::firmware
