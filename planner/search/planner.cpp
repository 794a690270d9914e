#include "planner/search/planner.hpp"

#include <algorithm>

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
  phase_ = Phase::kDone;
  has_best_ = false;
  parameters_ = problem.colony;
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
  if (const Refusal refusal = graph_.build(problem.map, problem.graph, bodies)) {
    return refusal;
  }

  const std::span<double> mass(belief_.mass.data(), index(cells_.count()));
  fill_prior(cells_, problem.prior, mass);
  if (const Refusal refusal = sight_.build(cells_, graph_, radii_m, mass)) {
    return refusal;
  }
  if (const Refusal refusal = normalise(sight_, cells_.count(), graph_.agents(), belief_)) {
    return refusal;
  }
  const double observable_m2 = belief_.mass_cell_count * cells_.cell_m() * cells_.cell_m();
  belief_.sub_prior_steps = step_of(kSubPriorHorizon * observable_m2 / swept_m2_a_second);
  if (!problem.sub_priors.empty()) {
    for (std::size_t m = 0; m < bodies.size(); ++m) {
      fill_prior(cells_, problem.sub_priors[m], std::span<double>(belief_.sub_mass[m].data(), index(cells_.count())));
    }
    deal(sight_, belief_, left_without_sub_prior_);
  } else if (const Refusal refusal = divide(cells_, sight_, preferred, belief_, left_without_sub_prior_)) {
    return refusal;
  }
  start_colony();
  return {};
}

void Planner::start_colony() noexcept {
  trails_.start(graph_, parameters_.rho, parameters_.beta);
  rng_ = Rng(parameters_.seed);
  generation_ = 0;
  ants_done_ = 0;
  phase_ = Phase::kAnts;
  ant_.start(parameters_.ant);
}

Progress Planner::step(Budget budget) noexcept {
  for (int left = budget.units; left > 0 && phase_ != Phase::kDone;) {
    left -= advance();
  }
  return progress();
}

Progress Planner::progress() const noexcept {
  return {.generation = generation_,
          .generations = parameters_.generations,
          .done = phase_ == Phase::kDone,
          .has_plan = has_best_,
          .best = best_.score};
}

Bounds Planner::bounds(double /*unseen_mass*/) const noexcept { return {}; }

int Planner::advance() noexcept {
  switch (phase_) {
    case Phase::kAnts:
      return ant_.done() ? end_ant() : ant_.advance(rng_, kRowsAPart);
    case Phase::kRaise:
    case Phase::kEvaporate:
    case Phase::kClamp:
      return sweep_trails();
    case Phase::kDone:
      break;
  }
  return 0;
}

double Planner::cost(const PlanScore& score) const noexcept {
  return belief_.has_sub_priors ? score.expected_sub_prior_time_s : score.expected_time_s;
}

bool Planner::better(const PlanScore& a, const PlanScore& b) const noexcept {
  if (a.complete != b.complete) {
    return a.complete;
  }
  return a.complete ? cost(a) < cost(b) : a.unseen_mass < b.unseen_mass;
}

int Planner::end_ant() noexcept {
  int work = 1;
  if (ants_done_ == 0 || better(ant_.score(), generation_best_.score)) {
    ant_.finish(generation_best_);
    for (const EdgePath& path : generation_best_.paths) {
      work += static_cast<int>(path.size());
    }
  }
  ++ants_done_;
  if (ants_done_ < parameters_.ants) {
    ant_.start(parameters_.ant);
    return work;
  }
  return work + end_ants();
}

int Planner::end_ants() noexcept {
  ants_done_ = 0;
  ++generation_;
  if (!has_best_ || better(generation_best_.score, best_.score)) {
    best_ = generation_best_;
    has_best_ = true;
    trails_.set_limits(std::max(cost(best_.score), kStepSeconds));
  }
  if (generation_ >= parameters_.generations || cost(best_.score) <= 0.0) {
    phase_ = Phase::kDone;  // nothing is cheaper than a plan that sees everything from the starts
    return 1;
  }
  sweep_agent_ = 0;
  sweep_edge_ = 0;
  phase_ = generation_ == 1 ? Phase::kRaise : Phase::kEvaporate;
  return 1;
}

// To tau_max after generation 1; then evaporation, deposit, clamp: over all trails, some rows at a time.
int Planner::sweep_trails() noexcept {
  const Edge count = std::min<Edge>(kRowsAPart, graph_.edges() - sweep_edge_);
  if (phase_ == Phase::kRaise) {
    trails_.raise_to_max(sweep_agent_, sweep_edge_, count);
  } else if (phase_ == Phase::kEvaporate) {
    trails_.evaporate(sweep_agent_, sweep_edge_, count);
  } else {
    trails_.clamp(sweep_agent_, sweep_edge_, count);
  }
  sweep_edge_ += count;
  if (sweep_edge_ < graph_.edges()) {
    return count + 1;
  }
  sweep_edge_ = 0;
  ++sweep_agent_;
  if (sweep_agent_ < graph_.agents()) {
    return count + 1;
  }
  sweep_agent_ = 0;
  if (phase_ == Phase::kRaise) {
    phase_ = Phase::kEvaporate;
    return count + 1;
  }
  if (phase_ == Phase::kEvaporate) {
    phase_ = Phase::kClamp;
    return count + 1 + deposit();
  }
  phase_ = Phase::kAnts;
  ant_.start(parameters_.ant);
  return count + 1;
}

int Planner::deposit() noexcept {
  const Tour& depositor = rng_.unit() < parameters_.iteration_best ? generation_best_ : best_;
  const double amount = 1.0 / std::max(cost(depositor.score), kStepSeconds);
  int work = 0;
  for (int m = 0; m < graph_.agents(); ++m) {
    for (const Edge e : depositor.paths[index(m)]) {
      trails_.deposit(m, e, amount);
      ++work;
    }
  }
  return work;
}

void Planner::best_plan(Plan& plan) const noexcept {
  IVO_CONTRACT(has_best_);
  plan.paths.clear();
  plan.score = best_.score;
  for (int m = 0; m < graph_.agents(); ++m) {
    plan.paths.resize(index(m) + 1);
    AgentPath& path = plan.paths[index(m)];
    path.waypoints.clear();
    path.duration_s = best_.end_s[index(m)];
    path.length_m = path.duration_s * speeds_mps_[index(m)];
    (void)path.waypoints.push_back(graph_.position(m));
    Point from = graph_.position(m);
    double left_m = path.length_m;
    for (const Edge e : best_.paths[index(m)]) {
      const Point to = graph_.position(graph_.head(e));
      const double length_m = graph_.length_m(e);
      // The last edge is cut at the sight point that shows the last new cell.
      const int points = sight_.points(e);
      const int last_point = length_m > 0 ? static_cast<int>(left_m / length_m * points + 0.5) : points;
      const Point end = left_m < length_m ? sight_point(from, to, std::min(last_point, points), points) : to;
      (void)path.waypoints.push_back(end);
      left_m -= length_m;
      from = to;
    }
  }
}

}  // namespace ivo::planner
