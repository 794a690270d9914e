// report.json: how a search went. Only what the mission and its people decide, nothing that the host's pace decides.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/semantic_class.hpp"
#include "firmware/files/score_document.hpp"

namespace ivo::firmware {

enum class RunEnd : std::uint8_t { kFound, kPathsEnded, kStopped, kFault, kNoConsent };

/// Driven or walked.
struct ReportedTrack {
  double distance_m = 0.0;
  double mean_speed_mps = 0.0;
  Point final_position;
};

struct ReportedAgent {
  std::string name;
  AgentKind kind = AgentKind::kRobot;
  double planned_length_m = 0.0;
  std::optional<ReportedTrack> driven;  ///< none where nobody knows
};

struct ReportDocument {
  std::string mission;
  std::uint64_t seed = 0;
  RunEnd end = RunEnd::kStopped;
  std::string reason;                 ///< one line
  std::optional<std::string> finder;  ///< name of the agent
  std::optional<Point> object;
  std::optional<ScoreDocument> score;    ///< of the plan; none when there was no plan yet
  std::optional<BoundsDocument> bounds;  ///< with the score
  double real_search_time_s = 0.0;
  std::vector<ReportedAgent> agents;
  std::string drive_fault;  ///< empty without one
};

/// Same document, same bytes, as plan_json. `end` as "found", "paths_ended", "stopped", "fault" or "no_consent".
[[nodiscard]] std::string report_json(const ReportDocument& report);

}  // namespace ivo::firmware
