#include "planner/search/planner.hpp"

#include <algorithm>
#include <cmath>

#include "planner/search/problem_checks.hpp"
#include "planner/world/graph_table.hpp"
#include "planner/world/visibility.hpp"

namespace ivo::planner {
namespace {

// K is four times the least time in which the team could sweep what it can observe.
constexpr double kSubPriorHorizon = 4.0;

void fill_prior(const Cells& cells, const PriorChoice& prior, std::span<double> mass) noexcept {
  if (const auto* components = std::get_if<std::span<const GaussianComponent>>(&prior)) {
    fill_gaussian_mixture(cells, *components, mass);
  } else if (const auto* image = std::get_if<GreyView>(&prior)) {
    fill_from_image(cells, *image, mass);
  } else {
    fill_uniform(cells, mass);
  }
}

}  // namespace

Refusal Planner::prepare(const SearchProblem& problem) noexcept {
  search_.stop();
  map_ = problem.map;
  clearance_m_ = problem.graph.clearance_m;
  bodies_.clear();
  if (const Refusal refusal = check(problem)) {
    return refusal;
  }
  if (const Refusal refusal = cells_.build(problem.map, problem.cell_m)) {
    return refusal;
  }

  GraphAgents bodies;
  PreferredAreas preferred;
  SightRadii radii_m{};
  double swept_m2_a_second = 0.0;
  for (const SearchAgent& agent : problem.agents) {
    const std::size_t m = bodies.size();
    (void)bodies.push_back(agent.body);
    (void)preferred.push_back(agent.preferred);
    radii_m[m] = agent.sight_radius_m;
    speeds_mps_[m] = agent.speed_mps;
    (void)bodies_.push_back({.kind = agent.body.kind,
                             .footprint_radius_m = agent.body.footprint_radius_m,
                             .sight_radius_m = agent.sight_radius_m,
                             .restricted = agent.body.restricted});
    swept_m2_a_second += 2.0 * agent.sight_radius_m * agent.speed_mps;
  }
  if (const Refusal refusal = problem.graph_table != nullptr ? graph_.load(*problem.graph_table, bodies)
                                                             : graph_.build(problem.map, problem.graph, bodies)) {
    return refusal;
  }

  const std::span<double> mass(raw_mass_.data(), index(cells_.count()));
  fill_prior(cells_, problem.prior, mass);
  for (Cell c = 0; problem.searched != nullptr && c < cells_.count(); ++c) {
    mass[index(c)] = problem.searched->contains(c) ? 0.0 : mass[index(c)];
  }
  if (const Refusal refusal = sight_.build(cells_, graph_, radii_m)) {
    return refusal;
  }
  if (const Refusal refusal = normalise(cells_, sight_, graph_.agents(), mass, belief_)) {
    return refusal;
  }
  const double observable_m2 = belief_.mass_cell_count * cells_.cell_m() * cells_.cell_m();
  belief_.sub_prior_steps = step_of(kSubPriorHorizon * observable_m2 / swept_m2_a_second);
  const auto* components = std::get_if<std::span<const GaussianComponent>>(&problem.prior);
  const Refusal refusal =
      std::holds_alternative<std::monostate>(problem.sub_priors)
          ? divide(cells_, sight_, preferred, belief_, left_without_sub_prior_)
          : give_sub_priors(cells_, sight_, problem.sub_priors,
                            components != nullptr ? *components : std::span<const GaussianComponent>(), belief_,
                            left_without_sub_prior_);
  if (refusal) {
    return refusal;
  }
  build_bounds(problem);
  fill_paces();
  parameters_ = problem.colony;
  search_.start(parameters_);
  return {};
}

void Planner::fill_paces() noexcept {
  for (int m = 0; m < graph_.agents(); ++m) {
    for (Edge e = 0; e < graph_.edges(); ++e) {
      paces_[index(m)][index(e)] = Pace(graph_.length_m(e) / (sight_.points(e) * speeds_mps_[index(m)]));
    }
  }
}

void Planner::build_bounds(const SearchProblem& problem) noexcept {
  StaticVector<BoundAgent, limits::kAgents> agents;
  for (const SearchAgent& agent : problem.agents) {
    (void)agents.push_back({.walker = {agent.body.start, agent.body.kind, agent.body.footprint_radius_m},
                            .speed_mps = agent.speed_mps,
                            .sight_radius_m = agent.sight_radius_m});
  }
  bounds_.build(problem.map, cells_, belief_, agents.span());
}

}  // namespace ivo::planner
