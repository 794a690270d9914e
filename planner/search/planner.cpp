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

// Of MMAS, before its best plan is improved.
constexpr int kFastGenerations = 5;

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
  ready_ = false;
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
    swept_m2_a_second += 2.0 * agent.sight_radius_m * agent.speed_mps;
  }
  if (const Refusal refusal = problem.graph_table != nullptr ? graph_.load(*problem.graph_table, bodies)
                                                             : graph_.build(problem.map, problem.graph, bodies)) {
    return refusal;
  }

  const std::span<double> mass(raw_mass_.data(), index(cells_.count()));
  fill_prior(cells_, problem.prior, mass);
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
  profile_ = problem.colony.profile;
  generations_ = problem.colony.generations;
  improving_ = false;
  ColonyParameters colony = problem.colony;
  if (profile_ == Profile::kFast) {
    open_improver(problem);
    if (improvable_) {
      colony.generations = std::min(kFastGenerations, generations_);
    }
  }
  colony_.start(colony);
  ready_ = true;
  return {};
}

void Planner::fill_paces() noexcept {
  for (int m = 0; m < graph_.agents(); ++m) {
    for (Edge e = 0; e < graph_.edges(); ++e) {
      paces_[index(m)][index(e)] = Pace(graph_.length_m(e) / (sight_.points(e) * speeds_mps_[index(m)]));
    }
  }
}

void Planner::open_improver(const SearchProblem& problem) noexcept {
  Bodies bodies;
  for (const SearchAgent& agent : problem.agents) {
    (void)bodies.push_back({.kind = agent.body.kind,
                            .footprint_radius_m = agent.body.footprint_radius_m,
                            .sight_radius_m = agent.sight_radius_m,
                            .restricted = agent.body.restricted});
  }
  improvable_ = improver_.open(problem.map, bodies, problem.graph.clearance_m, speeds_mps_,
                               {.max_unseen_mass = problem.colony.ant.max_unseen_mass, .seed = problem.colony.seed});
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

Progress Planner::step(Budget budget) noexcept {
  for (int left = budget.units; left > 0 && !progress().done;) {
    if (improving_) {
      left -= improver_.advance(Colony::kRowsAPart);
    } else if (!colony_.done()) {
      left -= colony_.advance();
    } else {
      improver_.start(colony_.best());
      improving_ = true;
      --left;
    }
  }
  return progress();
}

Progress Planner::progress() const noexcept {
  Progress progress{.generation = colony_.generation(),
                    .generations = generations_,
                    .done = !ready_,
                    .has_plan = ready_ && colony_.has_best(),
                    .best = {}};
  if (!ready_) {
    return progress;
  }
  const bool improves = profile_ == Profile::kFast && improvable_;
  progress.generation += improving_ ? improver_.generation() : 0;
  progress.done = colony_.done() && (!improves || progress.generation >= generations_);
  if (progress.has_plan) {
    progress.best = improved() ? improver_.best_score() : colony_.best().score;
  }
  return progress;
}

void Planner::best_plan(Plan& plan) const noexcept {
  IVO_CONTRACT(ready_ && colony_.has_best());
  const Tour& best = colony_.best();
  plan.score = improved() ? improver_.best_score() : best.score;
  plan.paths.resize(index(graph_.agents()));
  for (int m = 0; m < graph_.agents(); ++m) {
    AgentPath& path = plan.paths[index(m)];
    path.waypoints.clear();
    (void)path.waypoints.push_back(graph_.position(m));
    if (improved()) {
      for (const Place& place : improver_.best_waypoints(m)) {
        if (!(place == improver_.best_waypoints(m)[0])) {
          (void)path.waypoints.push_back(improver_.point_at(place));
        }
      }
    } else {
      for (const Edge e : best.paths[index(m)]) {
        (void)path.waypoints.push_back(graph_.position(graph_.head(e)));
      }
    }
    cut(path, improved() ? improver_.best_end_s(m) : to_double(best.end_s[index(m)]), speeds_mps_[index(m)]);
  }
}

// A path ends at the sight point that shows its last new cell.
void Planner::cut(AgentPath& path, double end_s, double speed_mps) const noexcept {
  path.duration_s = end_s;
  path.length_m = end_s * speed_mps;
  double left_m = path.length_m;
  std::size_t kept = 1;
  for (; kept < path.waypoints.size() && left_m > 1e-9; ++kept) {
    const Point from = path.waypoints[kept - 1];
    Point& to = path.waypoints[kept];
    const double dx = to.x_m - from.x_m;
    const double dy = to.y_m - from.y_m;
    const double length_m = std::sqrt(dx * dx + dy * dy);
    if (left_m < length_m) {
      const int points = sight_points(length_m, cells_.cell_m());
      const int last = static_cast<int>(left_m / length_m * points + 0.5);
      to = sight_point(from, to, std::min(last, points), points);
    }
    left_m -= length_m;
  }
  path.waypoints.resize(kept);
}

}  // namespace ivo::planner
