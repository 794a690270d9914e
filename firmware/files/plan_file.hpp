// plan.json: a plan and what the team can expect of it, for other programs and for a later run. The form is
// config/schemas/plan.schema.json.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "config/mission.hpp"
#include "firmware/files/score_document.hpp"

namespace ivo::firmware {

struct PlannedAgent {
  std::string name;
  AgentKind kind = AgentKind::kRobot;
  double speed_mps = 0.0;
  double sight_radius_m = 0.0;
  double length_m = 0.0;
  double duration_s = 0.0;
  std::vector<Point> waypoints;  ///< the first is the start
};

struct PlanDocument {
  std::string mission;
  std::string map;  ///< name of the map's file
  std::uint64_t seed = 0;
  SearchProfile profile = SearchProfile::kFast;
  SearchHeuristic heuristic = SearchHeuristic::kTsp;
  int threads = 1;       ///< colonies that searched
  std::string capacity;  ///< limits::Planner::kName
  double cell_m = 0.0;
  double spacing_m = 0.0;
  int nodes = 0;
  int generations_done = 0;
  double unobservable_share = 0.0;  ///< of the prior's mass; enters no score
  ScoreDocument score;
  BoundsDocument bounds;
  std::vector<PlannedAgent> agents;
};

/// Same document, same bytes: fixed order, numbers that read back as the same, no dates, no machine names. Numbers must
/// be finite. Ends with a line break.
[[nodiscard]] std::string plan_json(const PlanDocument& plan);

/// What plan_json wrote, checked: every field present, of its type and in range, waypoints finite, at least one agent.
/// Refuses with "PATH: FIELD: what was wrong; what is expected".
[[nodiscard]] Result<PlanDocument> read_plan(const std::string& path);

/// A path of a plan file that anybody may have made.
struct ForeignPath {
  std::optional<std::string> agent;  ///< none: the agent of the same place in the mission
  std::vector<Point> waypoints;      ///< at least one, finite
};

/// Agents' names and waypoints of any plan, in the file's order, at least one; nothing else in the file is looked at.
[[nodiscard]] Result<std::vector<ForeignPath>> read_paths(const std::string& path);

}  // namespace ivo::firmware
