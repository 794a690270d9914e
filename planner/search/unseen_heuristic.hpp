// Node choice by unseen mass: eta is the mass that the parts of the way to a neighbour would show, over its length.
// What a greedy planner would do next, as odds; recomputed at each step, from the swaths.
#pragma once

#include <array>
#include <cstdint>

#include "planner/numeric/roulette.hpp"
#include "planner/search/world.hpp"
#include "planner/world/view_walk.hpp"

namespace ivo::planner {

#if IVO_PLANNER_FIXED
using Eta = std::uint64_t;
#else
using Eta = double;
#endif

/// What a view would show an agent first, on its own sub-prior where there are any; a cell in sight of several of its
/// swaths counts once for each: quicker than once and for all, and what stays in sight longer is no worse to choose.
class UnseenMass {
 public:
  explicit UnseenMass(const World& world) noexcept : world_(world) {}

  void begin(int agent, const SightView& view) noexcept {
    agent_ = agent;
    mass_ = Mass{};
    walk_.begin(view);
  }
  /// Adds up about `rows` rows (> 0) at most. Returns the work done.
  int advance(const SeenMap& seen, int rows) noexcept;
  [[nodiscard]] bool done() const noexcept { return walk_.done(); }
  /// When done.
  [[nodiscard]] Mass mass() const noexcept { return mass_; }

 private:
  const World& world_;
  int agent_ = 0;
  ViewWalk walk_;
  Mass mass_{};
};

/// Mass a metre, in a unit of its own.
[[nodiscard]] Eta eta_of(Mass mass, double length_m) noexcept;

class UnseenHeuristic {
 public:
  explicit UnseenHeuristic(const World& world) noexcept : world_(world), shown_(world) {}

  /// An agent looks at the ways from a node. Cost: its edges.
  void begin(int agent, Node here) noexcept;
  /// Up to about `rows` rows of the ways that `wanted(edge)` does not leave out. Returns the work done.
  template <class Wanted>
  int advance(const SeenMap& seen, int rows, Wanted&& wanted) noexcept {
    int work = 1;
    while (edge_ < end_ && work <= rows) {
      if (!weighing_ && !wanted(edge_)) {
        ++edge_;
      } else {
        work += weigh(seen, rows - work + 1);
      }
    }
    return work;
  }
  [[nodiscard]] bool done() const noexcept { return edge_ == end_; }
  /// When done: eta^beta of an edge of the node, over that of its best edge; 0 when the way shows nothing new. Cost:
  /// beta.
  [[nodiscard]] Visibility visibility(Edge e, int beta) const noexcept;

 private:
  int weigh(const SeenMap& seen, int rows) noexcept;

  const World& world_;
  int agent_ = 0;
  Edge first_ = 0;
  Edge edge_ = 0;  // next
  Edge end_ = 0;
  UnseenMass shown_;
  bool weighing_ = false;  // edge_ is under way
  Eta best_{};
  std::array<Eta, limits::kNeighbours> etas_{};
};

}  // namespace ivo::planner
