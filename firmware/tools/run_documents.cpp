#include "firmware/tools/run_documents.hpp"

#include <cstdio>

#include "drivers/drive_fault_text.hpp"

namespace ivo::firmware {
namespace {

std::string fixed(double value, int decimals) {
  char text[64];
  (void)std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

const std::string& name_of_agent(const RunView& run, int agent) {
  return run.inputs.file.mission.agents[static_cast<std::size_t>(agent)].name;
}

}  // namespace

double mean_speed_mps(const AgentTrack& track) {
  return track.under_way > Duration::zero() ? track.moved_m / seconds(track.under_way) : 0.0;
}

RunOutcome outcome_of(const RunView& run, const LoopStatus& status, bool stalled) {
  if (stalled) {
    return {RunEnd::kFault, "the drives no longer answer; expected ivo-drives --clock sync on the same interface"};
  }
  if (status.mode == Mode::kFault) {
    if (status.drive_fault.reason != drivers::DriveFaultReason::kNone) {
      return {RunEnd::kFault, drivers::describe(status.drive_fault)};
    }
    return {RunEnd::kFault, "the drives lost power or did not come to rest"};
  }
  if (!status.power_off) {
    return {RunEnd::kFault, status.drive_fault.reason != drivers::DriveFaultReason::kNone
                                ? drivers::describe(status.drive_fault)
                                : "the drives did not confirm that they are off"};
  }
  if (status.stop_cause == StopCause::kNoConsent) {
    return {RunEnd::kNoConsent, "nobody consented to the plans"};
  }
  if (status.finder) {
    const AgentSpec& finder = run.inputs.file.mission.agents[static_cast<std::size_t>(*status.finder)];
    return {RunEnd::kFound, finder.name + " found the object after " + fixed(seconds(status.search_time), 1) + " s"};
  }
  if (status.stop_cause == StopCause::kPlanNotKept) {
    return {RunEnd::kStopped, "the plans could not be written"};
  }
  if (status.stop_cause == StopCause::kAsked) {
    return {RunEnd::kStopped, "stop was asked for"};
  }
  return {RunEnd::kPathsEnded, "the paths ended and nobody found the object"};
}

ReportDocument report_document(const RunView& run, const planner::Plan* plan, const LoopStatus& status,
                               const RunOutcome& outcome) {
  const Mission& mission = run.inputs.file.mission;
  ReportDocument report;
  report.mission = mission.name;
  report.seed = mission.seed;
  report.end = outcome.end;
  report.reason = outcome.reason;
  if (status.finder) {
    report.finder = name_of_agent(run, *status.finder);
  }
  report.object = run.object.place();
  if (plan != nullptr) {
    report.score = score_document(run, plan->score);
    report.bounds = bounds_of(run, plan->score);
  }
  report.real_search_time_s = status.search_started ? seconds(status.search_time) : 0.0;
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    const AgentSpec& spec = mission.agents[m];
    ReportedAgent agent{.name = spec.name, .kind = spec.kind, .planned_length_m = 0.0, .driven = {}};
    agent.planned_length_m = plan != nullptr ? plan->paths[m].length_m : 0.0;
    const bool reported = status.report_age[m].has_value();
    if (spec.kind == AgentKind::kRobot || spec.motion == PersonMotion::kSimulated || reported) {
      const AgentTrack& track = status.tracks[m];
      agent.driven = ReportedTrack{track.moved_m, mean_speed_mps(track), track.position};
    }
    report.agents.push_back(agent);
  }
  if (status.drive_fault.reason != drivers::DriveFaultReason::kNone) {
    report.drive_fault = drivers::describe(status.drive_fault);
  }
  return report;
}

SearchPicture picture_of(const RunView& run, const planner::Plan& plan, const LoopStatus& status,
                         const RunOutcome& outcome, const std::vector<std::vector<Point>>& tracks) {
  SearchPicture picture = plan_picture(run, plan, outcome.reason);
  for (std::size_t m = 0; m < picture.agents.size(); ++m) {
    picture.agents[m].track = tracks[m];
  }
  if (status.search_started) {
    picture.object = run.object.place();
    picture.figures += "; searched for " + fixed(seconds(status.search_time), 1) + " s";
  }
  if (status.finder) {
    const auto finder = static_cast<std::size_t>(*status.finder);
    picture.find =
        PicturedFind{finder, status.tracks[finder].position, run.inputs.file.mission.agents[finder].sight_radius_m};
  }
  return picture;
}

}  // namespace ivo::firmware
