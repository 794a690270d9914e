// The documents of a run: report.json and the picture, from what was read, planned and done.
#pragma once

#include <string>
#include <vector>

#include "firmware/files/report_file.hpp"
#include "firmware/loop/loop_status.hpp"
#include "firmware/mission/search_object.hpp"
#include "firmware/tools/plan_documents.hpp"

namespace ivo::firmware {

/// What a run is, in one place, for the documents and the terminal. All outlive it.
struct RunView : PlanView {
  const SearchObject& object;
};

/// How the run ended, and why in one line.
struct RunOutcome {
  RunEnd end = RunEnd::kStopped;
  std::string reason;
};

/// While the agent's path lasted; 0 when it never set off.
[[nodiscard]] double mean_speed_mps(const AgentTrack& track);
[[nodiscard]] RunOutcome outcome_of(const RunView& run, const LoopStatus& status, bool stalled);
/// `plan` may be null when there is none yet.
[[nodiscard]] ReportDocument report_document(const RunView& run, const planner::Plan* plan, const LoopStatus& status,
                                             const RunOutcome& outcome);
[[nodiscard]] SearchPicture picture_of(const RunView& run, const planner::Plan& plan, const LoopStatus& status,
                                       const RunOutcome& outcome, const std::vector<std::vector<Point>>& tracks);

}  // namespace ivo::firmware
