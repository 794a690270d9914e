// One ant: builds a path for every agent, move by move, and can be stopped between any two moves' parts (model.md,
// "Search (MMAS)"). It keeps what is seen as bits; the exact cost is left to who needs it (tour_scorer.hpp), and a
// lower and an upper bound of it fall out on the way.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "planner/numeric/index.hpp"
#include "planner/numeric/rng.hpp"
#include "planner/search/jump_search.hpp"
#include "planner/search/lookahead.hpp"
#include "planner/search/sector_heuristic.hpp"
#include "planner/search/tour.hpp"
#include "planner/search/trails.hpp"
#include "planner/search/unseen_heuristic.hpp"
#include "planner/search/work.hpp"
#include "planner/search/world.hpp"
#include "planner/world/view_walk.hpp"

namespace ivo::planner {

struct AntParameters {
  double shortest_first = 0.9;     ///< q: probability of extending the agent whose path ends earliest in time
  double max_unseen_mass = 0.014;  ///< done at or below
  /// When no unvisited node shows anything new, goes on to any node or along any edge that does: the nearest.
  bool completes = false;
  /// Above 0: no draws; always the agent whose path ends earliest, and the best of so many moves ahead (lookahead.hpp).
  int looks_ahead = 0;
  double patience = 4.0;  ///< of lookahead.hpp
};

class Ant {
 public:
  Ant(const World& world, const Trails& trails) noexcept
      : world_(world), trails_(trails), sectors_(world), unseen_mass_(world), lookahead_(world), shown_there_(world) {}

  /// Puts every agent on its start. `beta` is for eta_MTS; eta_TSP is in the trails. Cost: constant; the seen map comes
  /// in parts.
  void start(const AntParameters& parameters, Heuristic heuristic, int beta) noexcept;

  /// Does a part of the work: a choice, up to `rows` rows of a move, of a look ahead or of a jump's look, one node of a
  /// jump search. Returns the work done, in units (planner.hpp). Nothing when done.
  int advance(Rng& rng, int rows) noexcept;

  [[nodiscard]] bool done() const noexcept { return phase_ == Phase::kDone; }
  /// Another mission. Cost: the cells with mass, agents times nodes.
  void open() noexcept {
    moves_made_ = 0;
    sectors_.open();
    lookahead_.open();
    jump_.open(world_.graph);
  }

  /// When done: an unscored tour. Cost of the copy: the edges.
  void finish(Tour& tour) const noexcept;
  // When done:
  [[nodiscard]] bool complete() const noexcept;
  [[nodiscard]] Mass unseen() const noexcept { return unseen_; }
  /// Of Eq. 8, of a complete tour; the exact cost lies inside.
  [[nodiscard]] CostInterval cost() const noexcept;

  /// Edges walked by all ants since open().
  [[nodiscard]] std::int64_t moves() const noexcept { return moves_made_; }

 private:
  enum class Phase : std::uint8_t {
    kClear,
    kLookFromStarts,
    kChooseAgent,
    kWeigh,
    kLookAhead,
    kChooseNode,
    kJump,
    kLookAtNode,
    kLookAround,
    kMove,
    kDone
  };
  struct Move {
    Seconds end_s{};
    Mass shown{};  // what it showed first
  };

  int clear(int rows) noexcept;
  int look_from_starts(int rows) noexcept;
  int choose_agent(Rng& rng) noexcept;
  int weigh(int rows) noexcept;
  [[nodiscard]] Visibility visibility(Edge e) const noexcept;
  int look_ahead(int rows) noexcept;
  int choose_node(Rng& rng) noexcept;
  int jump(int rows) noexcept;
  void begin_jump() noexcept;
  [[nodiscard]] bool judges_jumps() const noexcept { return parameters_.looks_ahead > 0 && !second_wind_; }
  int look_at_node(int rows) noexcept;
  void judge_jump(Node n) noexcept;
  int look_around(int rows) noexcept;
  void go_to(Node n, Edge then = -1) noexcept;
  int move(int rows) noexcept;
  void begin_move() noexcept;
  void prefetch_next_choice(Node n) const noexcept;
  int look(const Swath& part, const std::uint64_t* words, int first_point, int last_point) noexcept;
  void end_move(Edge e) noexcept;
  void retire() noexcept;
  [[nodiscard]] bool may_share(int other, const EdgePath& path, std::size_t i, Edge e) const noexcept;
  void visit(Node n) noexcept { visited_[index(n)] = ant_number_; }
  [[nodiscard]] bool visited(Node n) const noexcept { return visited_[index(n)] == ant_number_; }
  [[nodiscard]] bool finds_new(int rows, int& work) noexcept;
  [[nodiscard]] int rows_at_once(int rows) const noexcept {
    return std::min(rows, heuristic_ == Heuristic::kMts ? work::kRowsAtOnceBySectors : work::kRowsAtOnce);
  }

  const World world_;
  const Trails& trails_;
  SectorHeuristic sectors_;
  UnseenHeuristic unseen_mass_;
  Lookahead lookahead_;
  AntParameters parameters_;
  Heuristic heuristic_ = Heuristic::kTsp;
  int beta_ = 0;
  Phase phase_ = Phase::kDone;

  std::uint32_t ant_number_ = 0;
  std::int64_t moves_made_ = 0;
  std::array<std::uint32_t, limits::kNodes> visited_{};
  SeenMap seen_;
  int cleared_ = 0;  // bytes of it
  Mass unseen_{};
  Mass low_steps_{};  // sum of p (k - 1), each cell at the earliest and the latest that its swath allows
  Mass high_steps_{};
  Seconds last_new_s_{};  // no earlier does the last path end

  std::array<Node, limits::kAgents> at_{};
  std::array<Seconds, limits::kAgents> time_s_{};
  std::array<bool, limits::kAgents> retired_{};
  std::array<EdgePath, limits::kAgents> paths_{};
  std::array<std::array<Move, limits::kWaypoints>, limits::kAgents> moves_{};

  int agent_ = 0;                                      // whose turn it is
  StaticVector<Edge, limits::kNodes> route_;           // of this turn, last edge first: one edge, or a jump's
  ViewWalk walk_;                                      // of the edge under way, or where something new is looked for
  Mass shown_{};                                       // by that edge
  std::array<Edge, limits::kNodes + 1> candidates_{};  // of a choice, and room for one that is none
  std::array<Weight, limits::kNodes> weights_{};       // their running sums
  JumpSearch jump_;
  Node jump_node_ = -1;  // looked at, or the edges from it
  Edge jump_edge_ = -1;  // one of them
  UnseenMass shown_there_;
  Node jump_to_ = -1;  // who looks ahead: the best so far
  Eta jump_rate_{};
  double jump_within_m_ = 0.0;
  bool second_wind_ = false;  // all were done once, and what is left is seen to
};

}  // namespace ivo::planner
