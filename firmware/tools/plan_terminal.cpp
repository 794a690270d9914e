#include "firmware/tools/plan_terminal.hpp"

#include <algorithm>
#include <variant>

namespace ivo::firmware {
namespace {

std::string prior_text(const MissionInputs& inputs) {
  if (inputs.prior_image) {
    const double pixel_m = std::get<ImagePrior>(inputs.file.mission.prior).resolution_m;
    const double width_m = inputs.prior_image->width_px * pixel_m;
    const double height_m = inputs.prior_image->height_px * pixel_m;
    const planner::SegmentedMap map = inputs.map.view();
    const bool smaller = width_m < map.width_m() || height_m < map.height_m();
    return format("image of %.1f x %.1f m", width_m, height_m) + (smaller ? ": nothing beyond it" : "");
  }
  if (inputs.gaussians.empty()) {
    return "uniform";
  }
  return inputs.gaussians.size() == 1 ? "a Gaussian"
                                      : format("%d Gaussians", static_cast<int>(inputs.gaussians.size()));
}

void show_agent(const AgentSpec& agent) {
  const auto areas = static_cast<int>(agent.preferred.size());
  say(agent.kind == AgentKind::kRobot ? "robot" : "person",
      agent.name + " from " + place_text(agent.start) +
          format(", %.2f m/s, sees %.1f m", agent.speed_mps, agent.sight_radius_m) +
          (areas == 0 ? std::string() : ", " + counted(areas, "preferred area")));
}

}  // namespace

void show_mission(const PlanView& view) {
  const Mission& mission = view.inputs.file.mission;
  const planner::SegmentedMap map = view.inputs.map.view();
  say("mission", mission.name + format(", seed %llu", static_cast<unsigned long long>(mission.seed)));
  say("map", view.inputs.map.path + format(", %.1f x %.1f m", map.width_m(), map.height_m()));
  for (const AgentSpec& agent : mission.agents) {
    show_agent(agent);
  }
  say("prior", prior_text(view.inputs));
  say("graph", counted(view.planner.graph().nodes(), "node") + format(" %.2f m apart, ", mission.planner.spacing_m) +
                   counted(view.planner.graph().edges(), "edge") + ", " +
                   counted(view.planner.cells().count(), "cell") +
                   format(" of %.2f m, %.1f %% of the prior out of everybody's sight", mission.planner.cell_m,
                          100 * view.planner.belief().unobservable_share));
  for (std::size_t m = 0; m < mission.agents.size(); ++m) {
    if (view.planner.graph().nodes_reached_by(static_cast<int>(m)) == 1) {
      say("note", mission.agents[m].name + " reaches no other node of the graph from its start");
    }
    if (planner::in(view.planner.left_without_sub_prior(), static_cast<int>(m))) {
      say("note", mission.agents[m].name + " has no probability of its own left and searches the whole prior");
    }
  }
}

void show_progress(LiveLine& line, const PlanView& view, const planner::Progress& progress, SearchTime time) {
  constexpr int kParts = 1000;
  const bool by_time = time.limit_s > 0.0;
  const int part =
      by_time ? static_cast<int>(kParts * std::min(1.0, time.elapsed_s / time.limit_s)) : progress.generation;
  const int whole = by_time ? kParts : progress.generations;
  if (!line.due(part, whole)) {
    return;
  }
  std::string text =
      by_time ? format("%.1f of %.1f s, ", time.elapsed_s, time.limit_s) + counted(progress.generation, "generation")
              : format("%d of ", progress.generation) + counted(progress.generations, "generation");
  if (progress.has_plan) {
    const planner::PlanScore& best = progress.best;
    text += format(", ET %.1f s, ET_c %.1f s, unseen %.1f %%", best.expected_time_s, best.expected_time_continuous_s,
                   100 * best.unseen_mass);
    if (const BoundsDocument bounds = bounds_of(view, best); bounds.gap) {
      text += format(", gap %.1f %%", 100 * *bounds.gap);
    }
    text += best.complete ? "" : ", incomplete";
  }
  line.draw("planning", line.live() ? bar(part, whole) + " " + text : text);
}

void show_paths(const PlanView& view, const planner::Plan& plan) {
  const auto& agents = view.inputs.file.mission.agents;
  for (std::size_t m = 0; m < agents.size(); ++m) {
    const planner::AgentPath& path = plan.paths[m];
    say("", agents[m].name + format(": %.1f m, %.0f s, ", path.length_m, path.duration_s) +
                counted(static_cast<int>(path.waypoints.size()), "waypoint") + ", ends at " +
                place_text(path.waypoints.back()));
  }
  if (!plan.score.complete) {
    say("note", format("the plans leave %.1f %% of the probability unsearched; a smaller spacing_m leaves less",
                       100 * plan.score.unseen_mass));
  }
}

void show_bound(const PlanView& view, const planner::PlanScore& score) {
  // The bounds are of ET_c: with sub-priors not what a search minimises, and no measure of how well it did.
  say("bound", bound_text(view, score) +
                   (view.planner.belief().has_sub_priors ? "; a search with sub-priors minimises EST, not ET_c" : ""));
}

void show_score(const PlanView& view, const planner::PlanScore& score) {
  say("ET", format("%.2f s (Eq. 8); ET_c %.2f s; the paths end at %.1f s", score.expected_time_s,
                   score.expected_time_continuous_s, score.horizon_s));
  if (view.planner.belief().has_sub_priors) {
    std::string est = format("%.2f s on the sub-priors", score.expected_sub_prior_time_s);
    if (score.expected_sub_prior_time_own_s > 0.0) {
      est += format("; %.2f s if each depletes its own alone", score.expected_sub_prior_time_own_s);
    }
    say("EST", est);
  }
  say("unseen",
      format("%.2f %% of the observable probability, %s; %.2f %% of all is unobservable", 100 * score.unseen_mass,
             score.complete ? "complete" : "incomplete", 100 * view.planner.belief().unobservable_share));
  show_bound(view, score);
}

}  // namespace ivo::firmware
