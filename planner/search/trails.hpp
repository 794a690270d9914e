// Pheromone of a MAX-MIN ant system (Eq. 1 to 3; Stuetzle and Hoos 2000; model.md, "Search (MMAS)"): one value a
// directed edge and agent, between limits that follow the best cost.
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/world/graph.hpp"

namespace ivo::planner {

class Trails {
 public:
  /// All equal, and eta^beta of eta_TSP = h / d for each edge. Cost: the edges.
  void start(const Graph& graph, double rho, int beta) noexcept;

  /// tau^alpha eta^beta of Eq. 2, alpha 1.
  [[nodiscard]] double attraction(int agent, Edge e) const noexcept {
    return tau_[index(agent)][index(e)] * visibility_[index(e)];
  }

  /// tau_max = 1 / (rho C_best) and tau_min below it.
  void set_limits(double best_cost) noexcept;
  /// To tau_max, for edges `first` to `first + count - 1` of an agent.
  void raise_to_max(int agent, Edge first, Edge count) noexcept;
  /// Eq. 1 for edges `first` to `first + count - 1` of an agent.
  void evaporate(int agent, Edge first, Edge count) noexcept;
  /// Eq. 3 for one edge.
  void deposit(int agent, Edge e, double amount) noexcept { tau_[index(agent)][index(e)] += amount; }
  /// Back between the limits, for edges `first` to `first + count - 1` of an agent.
  void clamp(int agent, Edge first, Edge count) noexcept;

  [[nodiscard]] double tau(int agent, Edge e) const noexcept { return tau_[index(agent)][index(e)]; }
  [[nodiscard]] double tau_min(int agent) const noexcept { return tau_min_[index(agent)]; }
  [[nodiscard]] double tau_max() const noexcept { return tau_max_; }

 private:
  int edges_ = 0;
  int agents_ = 0;
  double rho_ = 0.0;
  double tau_max_ = 1.0;
  std::array<double, limits::kAgents> tau_min_{};
  std::array<double, limits::kAgents> min_over_max_{};
  std::array<std::array<double, limits::kEdges>, limits::kAgents> tau_{};
  std::array<double, limits::kEdges> visibility_{};
};

}  // namespace ivo::planner
