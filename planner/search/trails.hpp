// Pheromone of a MAX-MIN ant system (Eq. 1 to 3; Stuetzle and Hoos 2000; model.md, "Search (MMAS)"): one value a
// directed edge and agent, between limits that follow the best cost.
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/numeric/prefetch.hpp"
#include "planner/numeric/roulette.hpp"
#include "planner/world/graph.hpp"

namespace ivo::planner {

class Trails {
 public:
  /// All equal, and eta^beta of eta_TSP = h / d for each edge. Cost: the edges.
  void start(const Graph& graph, double rho, int beta) noexcept;

  /// tau^alpha eta^beta of Eq. 2, alpha 1.
  [[nodiscard]] Weight attraction(int agent, Edge e) const noexcept {
    return weight_of(tau_[index(agent)][index(e)], visibility_[index(e)]);
  }
  /// The same with a heuristic of the moment, eta^beta.
  [[nodiscard]] Weight attraction(int agent, Edge e, Visibility visibility) const noexcept {
    return weight_of(tau_[index(agent)][index(e)], visibility);
  }

  /// Asks for what a choice among edges `first` to `first + count - 1` reads.
  void prefetch_choice(int agent, Edge first, int count) const noexcept {
    prefetch(tau_[index(agent)].data() + first, count);
    prefetch(visibility_.data() + first, count);
  }

  /// tau_max = 1 / (rho C_best) and tau_min below it; C in seconds, at least 1.
  void set_limits(Mass best_cost) noexcept;
  /// To tau_max, for edges `first` to `first + count - 1` of an agent.
  void raise_to_max(int agent, Edge first, Edge count) noexcept;
  /// Eq. 1 for edges `first` to `first + count - 1` of an agent.
  void evaporate(int agent, Edge first, Edge count) noexcept;
  /// Eq. 3 for one edge.
  void deposit(int agent, Edge e, Trail amount) noexcept { tau_[index(agent)][index(e)] += amount; }
  /// 1 / C, of the depositing plan's cost.
  [[nodiscard]] Trail amount_for(Mass cost) const noexcept;
  /// Back between the limits, for edges `first` to `first + count - 1` of an agent.
  void clamp(int agent, Edge first, Edge count) noexcept;

  /// In fixed point all three times rho (roulette.hpp).
  [[nodiscard]] Trail tau(int agent, Edge e) const noexcept { return tau_[index(agent)][index(e)]; }
  [[nodiscard]] Trail tau_min(int agent) const noexcept { return tau_min_[index(agent)]; }
  [[nodiscard]] Trail tau_max() const noexcept { return tau_max_; }

 private:
  int edges_ = 0;
  int agents_ = 0;
  Trail rho_{};
  Trail tau_max_{};
  std::array<Trail, limits::kAgents> tau_min_{};
  std::array<Trail, limits::kAgents> min_over_max_{};
  std::array<std::array<Trail, limits::kEdges>, limits::kAgents> tau_{};
  std::array<Visibility, limits::kEdges> visibility_{};
};

}  // namespace ivo::planner
