#include "planner/search/trails.hpp"

#include <algorithm>

#include "planner/numeric/exponential.hpp"

namespace ivo::planner {
namespace {

constexpr double kLog005 =
    -2.995732273553991;  // ln 0.05: the chance that a converged colony builds its best plan again

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
  rho_ = rho;
  tau_max_ = 1.0;
  // Starts may share a place; an edge of no length would draw every ant.
  const double shortest_m = graph.spacing_m() * 1e-3;
  for (Edge e = 0; e < edges_; ++e) {
    visibility_[index(e)] = whole_power(graph.spacing_m() / std::max(graph.length_m(e), shortest_m), beta);
  }
  for (int agent = 0; agent < agents_; ++agent) {
    min_over_max_[index(agent)] = min_over_max(graph.nodes_reached_by(agent), graph.edges_open_to(agent));
    raise_to_max(agent, 0, edges_);
  }
}

void Trails::set_limits(double best_cost) noexcept {
  tau_max_ = 1.0 / (rho_ * best_cost);
  for (int agent = 0; agent < agents_; ++agent) {
    tau_min_[index(agent)] = tau_max_ * min_over_max_[index(agent)];
  }
}

void Trails::raise_to_max(int agent, Edge first, Edge count) noexcept {
  std::fill_n(tau_[index(agent)].begin() + first, count, tau_max_);
}

void Trails::evaporate(int agent, Edge first, Edge count) noexcept {
  for (Edge e = first; e < first + count; ++e) {
    tau_[index(agent)][index(e)] *= 1.0 - rho_;
  }
}

void Trails::clamp(int agent, Edge first, Edge count) noexcept {
  const double low = tau_min_[index(agent)];
  for (Edge e = first; e < first + count; ++e) {
    double& tau = tau_[index(agent)][index(e)];
    tau = std::clamp(tau, low, tau_max_);
  }
}

}  // namespace ivo::planner
