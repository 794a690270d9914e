// score.json: what a plan of any origin is worth on a mission. The form is config/schemas/score.schema.json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/semantic_class.hpp"
#include "firmware/files/score_document.hpp"

namespace ivo::firmware {

struct ScoredAgent {
  std::string name;
  AgentKind kind = AgentKind::kRobot;
  double length_m = 0.0;        ///< up to where it last sees something new
  double duration_s = 0.0;      ///< of the same
  double given_length_m = 0.0;  ///< all waypoints of the file
  std::optional<double>
      preferred_share;  ///< by length, of length_m, in the agent's preferred areas; none without areas
};

struct ScoreFile {
  std::string mission;
  std::string map;   ///< name of the map's file
  std::string plan;  ///< name of the plan's file
  double cell_m = 0.0;
  double unobservable_share = 0.0;  ///< of the prior's mass; enters no score
  ScoreDocument score;
  BoundsDocument bounds;
  std::vector<ScoredAgent> agents;
};

/// Same document, same bytes, as plan_json.
[[nodiscard]] std::string score_json(const ScoreFile& file);

}  // namespace ivo::firmware
