#include "firmware/tools/plan_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "firmware/files/json_reading.hpp"
#include "firmware/files/number_text.hpp"
#include "planner/world/collision.hpp"

namespace ivo::firmware {
namespace {

constexpr double kStartTolerance_m = 0.01;

std::string names_of(const std::vector<AgentSpec>& agents) {
  std::string names;
  for (const AgentSpec& agent : agents) {
    names += (names.empty() ? "" : ", ") + agent.name;
  }
  return names;
}

/// What is in the way of the agent's footprint on the way from `a` to `b`; nothing when it is free.
std::optional<std::string> obstruction(const planner::SegmentedMap& map, const planner::GraphAgent& agent, Point a,
                                       Point b) {
  if (!map.contains(a) || !map.contains(b)) {
    return "leaves the map";
  }
  if (!planner::swept_disc_is_free(map, planner::obstacle_classes(map.classes), a, b, agent.footprint_radius_m)) {
    return "meets an obstacle or the map's border";
  }
  const auto may_not_enter = [&](Point p) {
    const SemanticClass there =
        map.at(static_cast<int>(p.x_m / map.resolution_m), static_cast<int>(p.y_m / map.resolution_m));
    return map.properties(there).restricted[static_cast<std::size_t>(agent.kind)];
  };
  const planner::ClassSet restricted = planner::restricted_classes(map.classes, agent.kind);
  if (may_not_enter(a) || may_not_enter(b) ||
      !planner::swept_disc_is_free(map, restricted, a, b, agent.footprint_radius_m)) {
    return "enters a class of ground that it may not enter";
  }
  if (planner::contains(agent.restricted, a) || planner::contains(agent.restricted, b) ||
      planner::touches(agent.restricted, a, b)) {
    return "enters a restricted area";
  }
  return std::nullopt;
}

std::optional<std::string> fault_of(const std::vector<Point>& way, const AgentSpec& spec,
                                    const planner::GraphAgent& body, const planner::SegmentedMap& map,
                                    const std::string& at) {
  if (way.size() > limits::kWaypoints) {
    return at + "waypoints_m: " + std::to_string(way.size()) + " waypoints, more than this build's " +
           std::to_string(limits::kWaypoints) + "; expected fewer";
  }
  const double off_m = std::hypot(way.front().x_m - spec.start.x_m, way.front().y_m - spec.start.y_m);
  if (off_m > kStartTolerance_m) {
    return at + "waypoints_m[0]: " + shortest(way.front()) + " is not where " + spec.name + " starts; expected " +
           shortest(spec.start);
  }
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (const std::optional<std::string> what = obstruction(map, body, way[i - 1], way[i])) {
      return at + element("waypoints_m", i) + ": the way of " + spec.name + " from " + shortest(way[i - 1]) + " to " +
             shortest(way[i]) + " " + *what + "; expected free ground for its footprint of " +
             shortest(body.footprint_radius_m) + " m";
    }
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<std::vector<Point>>> check_paths(const std::string& path, const std::vector<ForeignPath>& paths,
                                                    const MissionInputs& inputs) {
  const std::vector<AgentSpec>& agents = inputs.file.mission.agents;
  const planner::SearchProblem problem = inputs.problem();
  std::vector<std::vector<Point>> ways(agents.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string at = path + ": " + element("agents", i) + ".";
    const auto named = [&](const AgentSpec& spec) { return spec.name == paths[i].agent; };
    const auto m = paths[i].agent
                       ? static_cast<std::size_t>(std::find_if(agents.begin(), agents.end(), named) - agents.begin())
                       : i;
    if (m >= agents.size()) {
      return Error{at + "name: " + (paths[i].agent ? "\"" + *paths[i].agent + "\" is" : "one more than") +
                   (paths[i].agent ? " no agent of the mission" : " the mission has agents") + "; expected " +
                   names_of(agents)};
    }
    if (!ways[m].empty()) {
      return Error{at + "name: " + agents[m].name + " is there a second time; expected one path an agent"};
    }
    if (const auto fault = fault_of(paths[i].waypoints, agents[m], problem.agents[m].body, problem.map, at)) {
      return Error{*fault};
    }
    ways[m] = paths[i].waypoints;
  }
  for (std::size_t m = 0; m < agents.size(); ++m) {
    if (ways[m].empty()) {
      return Error{path + ": agents: " + agents[m].name + " is missing; expected a path for each of " +
                   names_of(agents)};
    }
  }
  return ways;
}

}  // namespace ivo::firmware
