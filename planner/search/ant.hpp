// One ant: builds a path for every agent, move by move, and can be stopped between any two moves' parts (model.md,
// "Search (MMAS)").
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "planner/numeric/index.hpp"
#include "planner/numeric/rng.hpp"
#include "planner/search/belief.hpp"
#include "planner/search/expected_time.hpp"
#include "planner/search/first_sightings.hpp"
#include "planner/search/jump_search.hpp"
#include "planner/search/trails.hpp"
#include "planner/world/sight_table.hpp"

namespace ivo::planner {

/// What every ant of a mission works on.
struct World {
  const Graph& graph;
  const SightTable& sight;
  const Belief& belief;
  const std::array<double, limits::kAgents>& speeds_mps;
};

struct AntParameters {
  double shortest_first = 0.9;     ///< q: probability of extending the agent whose path ends earliest in time
  double max_unseen_mass = 0.014;  ///< done at or below
};

/// Edges that an agent takes, in order, from its start.
using EdgePath = StaticVector<Edge, limits::kWaypoints - 1>;

/// What an ant built: every agent's edges up to the last that shows something new, and when the path ends on it.
struct Tour {
  StaticVector<EdgePath, limits::kAgents> paths;
  std::array<double, limits::kAgents> end_s{};
  PlanScore score;
};

class Ant {
 public:
  Ant(const World& world, const Trails& trails) noexcept : world_(world), trails_(trails) {}

  /// Puts every agent on its start. Cost: the starts' discs, and one a node.
  void start(const AntParameters& parameters) noexcept;

  /// Does a part of the work: a choice, up to `rows` table rows of a move or of the scoring, or one node of a jump
  /// search. Returns the work done, in units (planner.hpp). Nothing when done.
  int advance(Rng& rng, int rows) noexcept;

  [[nodiscard]] bool done() const noexcept { return phase_ == Phase::kDone; }
  /// When done. Cost of the copy: the edges.
  void finish(Tour& tour) const noexcept;
  [[nodiscard]] const PlanScore& score() const noexcept { return score_; }

 private:
  enum class Phase : std::uint8_t { kChooseAgent, kChooseNode, kJump, kMove, kScore, kDone };

  int choose_agent(Rng& rng) noexcept;
  int choose_node(Rng& rng) noexcept;
  int jump() noexcept;
  int move(int rows) noexcept;
  int score_some(int rows) noexcept;
  void take_edge(Edge e) noexcept;
  void retire() noexcept;
  [[nodiscard]] double seconds_a_point(int agent, Edge e) const noexcept;
  [[nodiscard]] double seconds_along(int agent, Edge e) const noexcept;
  void visit(Node n) noexcept { visited_[index(n)] = ant_number_; }
  [[nodiscard]] bool visited(Node n) const noexcept { return visited_[index(n)] == ant_number_; }
  [[nodiscard]] bool shows_something_new(Node n, int& work) const noexcept;

  const World world_;
  const Trails& trails_;
  AntParameters parameters_;
  Phase phase_ = Phase::kDone;

  std::uint32_t ant_number_ = 0;
  std::array<std::uint32_t, limits::kNodes> visited_{};
  FirstSightings sightings_;
  double unseen_mass_ = 1.0;

  std::array<Node, limits::kAgents> at_{};
  std::array<double, limits::kAgents> time_s_{};
  std::array<bool, limits::kAgents> retired_{};
  std::array<EdgePath, limits::kAgents> paths_{};

  int agent_ = 0;                             // whose turn it is
  StaticVector<Edge, limits::kNodes> route_;  // of this turn, last edge first: one edge, or a jump's
  std::size_t row_ = 0;                       // of the edge under way, or of the scoring
  std::array<double, limits::kNodes> weights_{};
  JumpSearch jump_;
  ExpectedTime expected_;
  PlanScore score_;
};

}  // namespace ivo::planner
