#include "firmware/tools/plan_documents.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <span>
#include <variant>

#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

/// Cells that the prior gives a part worth showing, a tenth of the mean, and the belief none: nobody can see them.
std::vector<bool> out_of_sight(const PlanView& view) {
  const planner::Cells& cells = view.planner.cells();
  std::vector<double> prior(static_cast<std::size_t>(cells.count()));
  const planner::PriorChoice choice = view.inputs.problem().prior;
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
    hidden.push_back(prior[c] > 0.1 * mean && view.planner.belief().mass[c] <= 0.0);
  }
  return hidden;
}

}  // namespace

BoundsDocument bounds_of(const PlanView& view, const planner::PlanScore& score) {
  const planner::Bounds bounds = view.planner.bounds(score.unseen_mass);
  BoundsDocument document{.area_s = bounds.area.nominal_s,
                          .area_strict_s = bounds.area.strict_s,
                          .reach_s = bounds.reach.nominal_s,
                          .reach_strict_s = bounds.reach.strict_s,
                          .gap = {}};
  if (bounds.bound_s() > 0.0) {
    document.gap = score.expected_time_continuous_s / bounds.bound_s() - 1.0;
  }
  return document;
}

std::string bound_text(const PlanView& view, const planner::PlanScore& score) {
  const BoundsDocument bounds = bounds_of(view, score);
  std::string text = format("%.1f s, strict %.1f s; ET_c %.1f s", std::max(bounds.area_s, bounds.reach_s),
                            std::max(bounds.area_strict_s, bounds.reach_strict_s), score.expected_time_continuous_s);
  if (!bounds.gap) {
    return text;
  }
  // Cells count at their centres: coarse ones let a plan see more than its discs cover.
  return *bounds.gap >= 0.0 ? text + format(" is %.1f %% above", 100 * *bounds.gap)
                            : text + format(" is %.1f %% below the first: the cells are coarse", -100 * *bounds.gap);
}

std::string score_text(const PlanView& view, const planner::PlanScore& score) {
  std::string text = format("expected time %.1f s", score.expected_time_s);
  if (view.planner.belief().has_sub_priors) {
    text = format("expected time %.1f s as preferred, %.1f s by anybody", score.expected_sub_prior_time_s,
                  score.expected_time_s);
  }
  text += format("; unseen %.1f %%", 100 * score.unseen_mass);
  return score.complete ? text : text + ", incomplete";
}

ScoreDocument score_document(const PlanView& view, const planner::PlanScore& score) {
  return {.expected_time_s = score.expected_time_s,
          .expected_time_continuous_s = score.expected_time_continuous_s,
          .expected_sub_prior_time_s =
              view.planner.belief().has_sub_priors ? std::optional(score.expected_sub_prior_time_s) : std::nullopt,
          .unseen_mass = score.unseen_mass,
          .horizon_s = score.horizon_s,
          .complete = score.complete,
          .expected_sub_prior_time_own_s = score.expected_sub_prior_time_own_s > 0.0
                                               ? std::optional(score.expected_sub_prior_time_own_s)
                                               : std::nullopt};
}

PlanDocument plan_document(const PlanView& view, const planner::Plan& plan, const PlanSearch& search) {
  const Mission& mission = view.inputs.file.mission;
  PlanDocument document{.mission = mission.name,
                        .map = std::filesystem::path(view.inputs.map.path).filename().string(),
                        .seed = mission.seed,
                        .profile = mission.planner.profile,
                        .heuristic = mission.planner.heuristic,
                        .threads = search.threads,
                        .capacity = limits::Planner::kName,
                        .cell_m = mission.planner.cell_m,
                        .spacing_m = mission.planner.spacing_m,
                        .nodes = view.planner.graph().nodes(),
                        .generations_done = search.generations_done,
                        .unobservable_share = view.planner.belief().unobservable_share,
                        .score = score_document(view, plan.score),
                        .bounds = bounds_of(view, plan.score),
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

SearchPicture plan_picture(const PlanView& view, const planner::Plan& plan, const std::string& title) {
  const Mission& mission = view.inputs.file.mission;
  const planner::Cells& cells = view.planner.cells();
  SearchPicture picture;
  picture.map = &view.inputs.map;
  picture.mass = std::span<const double>(view.planner.belief().mass.data(), static_cast<std::size_t>(cells.count()));
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
                              .track = {},
                              .preferred = spec.preferred,
                              .restricted = spec.restricted});
  }
  picture.alike = std::holds_alternative<UniformPrior>(mission.prior);
  picture.out_of_sight = out_of_sight(view);
  picture.title = mission.name + ": " + title;
  picture.figures = score_text(view, plan.score) + "; bound " + bound_text(view, plan.score);
  return picture;
}

}  // namespace ivo::firmware
