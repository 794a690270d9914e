#include <filesystem>
#include <utility>

#include "firmware/files/score_file.hpp"
#include "firmware/files/text_file.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/plan_check.hpp"
#include "firmware/tools/plan_options.hpp"
#include "firmware/tools/plan_terminal.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/preferred_share.hpp"
#include "firmware/tools/result_files.hpp"
#include "planner/search/path_score.hpp"

namespace ivo::firmware {
namespace {

using Ways = std::vector<std::vector<Point>>;

planner::PathScorer& the_scorer() {
  static planner::FirstSightings sightings;  // large
  static planner::PathScorer scorer(sightings);
  return scorer;
}

ScoredAgent scored_agent(const AgentSpec& spec, const planner::SearchAgent& agent, const std::vector<Point>& way,
                         double duration_s) {
  ScoredAgent scored{.name = spec.name,
                     .kind = spec.kind,
                     .length_m = duration_s * spec.speed_mps,
                     .duration_s = duration_s,
                     .given_length_m = planner::length_m(way),
                     .preferred_share = {}};
  if (!agent.preferred.empty()) {
    scored.preferred_share = share_inside(way, scored.length_m, agent.preferred);
  }
  return scored;
}

void show_agents(const std::vector<ScoredAgent>& agents) {
  for (const ScoredAgent& agent : agents) {
    std::string text = agent.name + format(": %.1f m, %.0f s", agent.length_m, agent.duration_s);
    if (agent.given_length_m > agent.length_m + 0.05) {
      text += format(" until it last sees something new, of %.1f m", agent.given_length_m);
    }
    if (agent.preferred_share) {
      text += format(", %.1f %% in preferred areas", 100 * *agent.preferred_share);
    }
    say("", text);
  }
}

/// As the file has it, to its last waypoint.
void fill(planner::Plan& plan, const Ways& ways, const planner::PlanScore& score) {
  plan.score = score;
  plan.paths.resize(ways.size());
  for (std::size_t m = 0; m < ways.size(); ++m) {
    plan.paths[m].waypoints.clear();
    for (const Point p : ways[m]) {
      IVO_CONTRACT(plan.paths[m].waypoints.push_back(p));  // check_paths refuses longer ways
    }
  }
}

bool keep_results(const ScoreOptions& options, const PlanView& view, const ScoreFile& file, const Ways& ways,
                  const planner::PlanScore& score) {
  bool kept = options.json.empty() || keep(options.json, score_json(file));
  if (!options.out.empty()) {
    static planner::Plan plan;  // large
    fill(plan, ways, score);
    kept = keep(options.out + "/score.json", score_json(file)) && kept;
    kept = keep(options.out + "/search.png", picture_png(plan_picture(view, plan, file.plan))) && kept;
  }
  return kept;
}

}  // namespace

int score(const ScoreOptions& options) {
  Result<MissionInputs> read = read_inputs(options.mission);
  if (!read) {
    return refuse(read.error());
  }
  const MissionInputs inputs = std::move(read).value();
  const Mission& mission = inputs.file.mission;
  const Result<std::vector<ForeignPath>> paths = read_paths(options.plan);
  if (!paths) {
    return refuse(paths.error());
  }
  planner::Planner& planner = the_planner();
  if (const Result<void> prepared = prepare(planner, inputs); !prepared) {
    return refuse(prepared.error());
  }
  const Result<Ways> checked = check_paths(options.plan, paths.value(), inputs);
  if (!checked) {
    return refuse(checked.error());
  }
  const Ways& ways = checked.value();
  const Result<void> json = options.json.empty() ? Result<void>() : check_writable(options.json);
  const Result<void> out =
      options.out.empty() ? Result<void>() : open_folder(options.out, {"score.json", "search.png"});
  if (!json || !out) {
    return refuse(json ? out.error() : json.error());
  }

  std::vector<planner::WaypointPath> scored;
  for (std::size_t m = 0; m < ways.size(); ++m) {
    scored.push_back({ways[m], mission.agents[m].speed_mps, mission.agents[m].sight_radius_m});
  }
  const planner::PlanScore score =
      the_scorer().score(planner.cells(), planner.belief(), scored, mission.planner.max_unseen_mass);
  const PlanView view{inputs, planner};
  const planner::SearchProblem problem = inputs.problem();
  ScoreFile file{.mission = mission.name,
                 .map = std::filesystem::path(inputs.map.path).filename().string(),
                 .plan = std::filesystem::path(options.plan).filename().string(),
                 .cell_m = mission.planner.cell_m,
                 .unobservable_share = planner.belief().unobservable_share,
                 .score = score_document(view, score),
                 .bounds = bounds_of(view, score),
                 .agents = {}};
  for (std::size_t m = 0; m < ways.size(); ++m) {
    file.agents.push_back(
        scored_agent(mission.agents[m], problem.agents[m], ways[m], the_scorer().path_end_s(static_cast<int>(m))));
  }
  say("mission", mission.name);
  say("plan", options.plan);
  show_score(view, score);
  show_agents(file.agents);
  return keep_results(options, view, file, ways, score) ? exit_status::kEnded : exit_status::kFaultOrStop;
}

}  // namespace ivo::firmware
