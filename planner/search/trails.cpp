#include "planner/search/trails.hpp"

#include <algorithm>

#include "planner/numeric/exponential.hpp"

namespace ivo::planner {
namespace {

constexpr double kLog005 =
    -2.995732273553991;  // ln 0.05: the chance that a converged colony builds its best plan again

// Numbers of a trail, in its own units.
#if IVO_PLANNER_FIXED
constexpr Trail kOne = Trail{1} << kTrailBits;
Trail trail_from(double value) noexcept { return static_cast<Trail>(value * kOne + 0.5); }
Trail times(Trail a, Trail b) noexcept { return static_cast<Trail>((static_cast<std::uint64_t>(a) * b) >> kTrailBits); }
Trail inverse(Mass cost) noexcept {
  return static_cast<Trail>((std::uint64_t{1} << (kTrailBits + Mass::kFraction)) /
                            static_cast<std::uint64_t>(cost.raw()));
}
#else
constexpr Trail kOne = 1.0;
Trail trail_from(double value) noexcept { return value; }
Trail times(Trail a, Trail b) noexcept { return a * b; }
Trail inverse(Mass cost) noexcept { return 1.0 / cost; }
#endif

double whole_power(double base, int exponent) noexcept {
  double power = 1.0;
  for (int i = 0; i < exponent; ++i) {
    power *= base;
  }
  return power;
}

// tau_min / tau_max for an agent's graph of n nodes: (1 - s) / ((a - 1) s), s = 0.05^(1/n), a the half of the mean
// degree.
double min_over_max(int nodes, int edges) noexcept {
  const double s = exp_negative(kLog005 / nodes);
  const double a = std::max(2.0, 0.5 * edges / nodes);
  return std::min(1.0, (1.0 - s) / ((a - 1.0) * s));
}

}  // namespace

void Trails::start(const Graph& graph, double rho, int beta) noexcept {
  edges_ = graph.edges();
  agents_ = graph.agents();
  rho_ = trail_from(rho);
  tau_max_ = kOne;
  // Starts may share a place; an edge of no length would draw every ant.
  const double shortest_m = graph.spacing_m() * 1e-3;
  for (Edge e = 0; e < edges_; ++e) {
    visibility_[index(e)] =
        visibility_from(whole_power(graph.spacing_m() / std::max(graph.length_m(e), shortest_m), beta));
  }
  for (int agent = 0; agent < agents_; ++agent) {
    min_over_max_[index(agent)] = trail_from(min_over_max(graph.nodes_reached_by(agent), graph.edges_open_to(agent)));
    raise_to_max(agent, 0, edges_);
  }
}

void Trails::set_limits(Mass best_cost) noexcept {
#if IVO_PLANNER_FIXED
  tau_max_ = inverse(best_cost);
#else
  tau_max_ = 1.0 / (rho_ * best_cost);
#endif
  for (int agent = 0; agent < agents_; ++agent) {
    tau_min_[index(agent)] = times(tau_max_, min_over_max_[index(agent)]);
  }
}

Trail Trails::amount_for(Mass cost) const noexcept {
#if IVO_PLANNER_FIXED
  return times(rho_, inverse(cost));
#else
  return inverse(cost);
#endif
}

void Trails::raise_to_max(int agent, Edge first, Edge count) noexcept {
  std::fill_n(tau_[index(agent)].begin() + first, count, tau_max_);
}

void Trails::evaporate(int agent, Edge first, Edge count) noexcept {
  for (Edge e = first; e < first + count; ++e) {
    Trail& tau = tau_[index(agent)][index(e)];
    tau = times(tau, kOne - rho_);
  }
}

void Trails::clamp(int agent, Edge first, Edge count) noexcept {
  const Trail low = tau_min_[index(agent)];
  for (Edge e = first; e < first + count; ++e) {
    Trail& tau = tau_[index(agent)][index(e)];
    tau = std::clamp(tau, low, tau_max_);
  }
}

}  // namespace ivo::planner
