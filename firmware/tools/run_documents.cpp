#include "firmware/tools/run_documents.hpp"

#include <cstdio>
#include <filesystem>
#include <numeric>
#include <span>
#include <utility>
#include <variant>

#include "drivers/drive_fault_text.hpp"

namespace ivo::firmware {
namespace {

std::string fixed(double value, int decimals) {
  char text[64];
  (void)std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

ScoreDocument score_document(const planner::PlanScore& score, bool has_sub_priors) {
  return {.expected_time_s = score.expected_time_s,
          .expected_time_continuous_s = score.expected_time_continuous_s,
          .expected_sub_prior_time_s = has_sub_priors ? std::optional(score.expected_sub_prior_time_s) : std::nullopt,
          .unseen_mass = score.unseen_mass,
          .horizon_s = score.horizon_s,
          .complete = score.complete};
}

const std::string& name_of_agent(const RunView& run, int agent) {
  return run.inputs.file.mission.agents[static_cast<std::size_t>(agent)].name;
}

}  // namespace

double mean_speed_mps(const AgentTrack& track) {
  return track.under_way > Duration::zero() ? track.moved_m / seconds(track.under_way) : 0.0;
}

std::string score_text(const RunView& run, const planner::PlanScore& score) {
  const std::string anybody = fixed(score.expected_time_s, 1) + " s";
  std::string text = "expected time " + anybody;
  if (run.planner.belief().has_sub_priors) {
    text = "expected time " + fixed(score.expected_sub_prior_time_s, 1) + " s as preferred, " + anybody + " by anybody";
  }
  text += "; unseen " + fixed(100 * score.unseen_mass, 1) + " %";
  return score.complete ? text : text + ", incomplete";
}

RunOutcome outcome_of(const RunView& run, const LoopStatus& status, bool stalled) {
  if (stalled) {
    return {RunEnd::kFault, "the drives no longer answer; expected ivo-drives --clock sync on the same interface"};
  }
  if (status.mode == Mode::kFault) {
    if (status.drive_fault.reason != drivers::DriveFaultReason::kNone) {
      return {RunEnd::kFault, drivers::describe(status.drive_fault)};
    }
    if (status.counters.bus_state >= hal::BusState::kOff) {
      return {RunEnd::kFault, "the CAN bus is off, down or gone"};
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

PlanDocument plan_document(const RunView& run, const planner::Plan& plan) {
  const Mission& mission = run.inputs.file.mission;
  PlanDocument document{.mission = mission.name,
                        .map = std::filesystem::path(run.inputs.map.path).filename().string(),
                        .seed = mission.seed,
                        .profile = limits::Planner::kName,
                        .cell_m = mission.planner.cell_m,
                        .spacing_m = mission.planner.spacing_m,
                        .nodes = run.planner.graph().nodes(),
                        .generations_done = run.planner.progress().generation,
                        .unobservable_share = run.planner.belief().unobservable_share,
                        .score = score_document(plan.score, run.planner.belief().has_sub_priors),
                        .agents = {}};
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    const AgentSpec& spec = mission.agents[m];
    const planner::AgentPath& path = plan.paths[m];
    document.agents.push_back({.name = spec.name,
                               .kind = spec.kind,
                               .speed_mps = spec.speed_mps,
                               .sight_radius_m = spec.sight_radius_m,
                               .length_m = path.length_m,
                               .duration_s = path.duration_s,
                               .waypoints = {path.waypoints.begin(), path.waypoints.end()}});
  }
  return document;
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
    report.score = score_document(plan->score, run.planner.belief().has_sub_priors);
  }
  report.real_search_time_s = status.search_started ? seconds(status.search_time) : 0.0;
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    const AgentSpec& spec = mission.agents[m];
    ReportedAgent agent{.name = spec.name, .kind = spec.kind, .planned_length_m = 0.0, .driven = {}};
    agent.planned_length_m = plan != nullptr ? plan->paths[m].length_m : 0.0;
    // Nobody has reported where a reported person was.
    if (spec.kind == AgentKind::kRobot || spec.motion == PersonMotion::kSimulated) {
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

namespace {

/// Cells that the prior gives a part worth showing, a tenth of the mean, and the belief none: nobody can see them.
std::vector<bool> out_of_sight(const RunView& run) {
  const planner::Cells& cells = run.planner.cells();
  std::vector<double> prior(static_cast<std::size_t>(cells.count()));
  const planner::PriorChoice choice = run.inputs.problem().prior;
  if (const auto* image = std::get_if<planner::GreyView>(&choice)) {
    planner::fill_from_image(cells, *image, prior);
  } else if (const auto* gaussians = std::get_if<std::span<const planner::GaussianComponent>>(&choice)) {
    planner::fill_gaussian_mixture(cells, *gaussians, prior);
  } else {
    planner::fill_uniform(cells, prior);
  }
  const double mean = std::accumulate(prior.begin(), prior.end(), 0.0) / cells.count();
  std::vector<bool> hidden;
  for (std::size_t c = 0; c < prior.size(); ++c) {
    hidden.push_back(prior[c] > 0.1 * mean && run.planner.belief().mass[c] <= 0.0);
  }
  return hidden;
}

}  // namespace

SearchPicture picture_of(const RunView& run, const planner::Plan& plan, const LoopStatus& status,
                         const RunOutcome& outcome, const std::vector<std::vector<Point>>& tracks) {
  const Mission& mission = run.inputs.file.mission;
  const planner::Cells& cells = run.planner.cells();
  SearchPicture picture;
  picture.map = &run.inputs.map;
  picture.mass = std::span<const double>(run.planner.belief().mass.data(), static_cast<std::size_t>(cells.count()));
  picture.columns = cells.columns();
  picture.rows = cells.rows();
  picture.cell_m = cells.cell_m();
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    const AgentSpec& spec = mission.agents[m];
    const planner::AgentPath& path = plan.paths[m];
    picture.agents.push_back({.name = spec.name,
                              .kind = spec.kind,
                              .start = spec.start,
                              .plan = {path.waypoints.begin(), path.waypoints.end()},
                              .track = tracks[m],
                              .preferred = spec.preferred,
                              .restricted = spec.restricted});
  }
  picture.alike = std::holds_alternative<UniformPrior>(mission.prior);
  picture.out_of_sight = out_of_sight(run);
  if (status.search_started) {
    picture.object = run.object.place();
  }
  if (status.finder) {
    const auto finder = static_cast<std::size_t>(*status.finder);
    picture.find = PicturedFind{finder, status.tracks[finder].position, mission.agents[finder].sight_radius_m};
  }
  picture.title = mission.name + ": " + outcome.reason;
  picture.figures = score_text(run, plan.score);
  if (status.search_started) {
    picture.figures += "; searched for " + fixed(seconds(status.search_time), 1) + " s";
  }
  return picture;
}

}  // namespace ivo::firmware
