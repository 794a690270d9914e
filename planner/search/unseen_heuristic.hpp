// Node choice by unseen mass: eta is the mass that the parts of the way to a neighbour would show, over its length.
// What a greedy planner would do next, as odds; recomputed at each step, from the swaths.
#pragma once

#include <array>
#include <cstdint>

#include "planner/numeric/roulette.hpp"
#include "planner/search/world.hpp"

namespace ivo::planner {

#if IVO_PLANNER_FIXED
using Eta = std::uint64_t;
#else
using Eta = double;
#endif

/// What a view would show an agent first, on its own sub-prior where there are any; a cell in sight of several of its
/// swaths counts once for each: quicker than once and for all, and what stays in sight longer is no worse to choose.
/// Adds the work done: its rows.
[[nodiscard]] Mass unseen_mass(const World& world, int agent, const SightView& view, const SeenMap& seen,
                               int& work) noexcept;
/// Mass a metre, in a unit of its own.
[[nodiscard]] Eta eta_of(Mass mass, double length_m) noexcept;

class UnseenHeuristic {
 public:
  explicit UnseenHeuristic(const World& world) noexcept : world_(world) {}

  /// An agent looks at the ways from a node. Cost: its edges.
  void begin(int agent, Node here) noexcept;
  /// Up to about `rows` rows of the ways that `wanted(edge)` does not leave out. Returns the work done.
  template <class Wanted>
  int advance(const SeenMap& seen, int rows, Wanted&& wanted) noexcept {
    int work = 1;
    for (; edge_ < end_ && work <= rows; ++edge_) {
      if (wanted(edge_)) {
        weigh(seen, work);
      }
    }
    return work;
  }
  [[nodiscard]] bool done() const noexcept { return edge_ == end_; }
  /// When done: eta^beta of an edge of the node, over that of its best edge; 0 when the way shows nothing new. Cost:
  /// beta.
  [[nodiscard]] Visibility visibility(Edge e, int beta) const noexcept;

 private:
  void weigh(const SeenMap& seen, int& work) noexcept;

  const World& world_;
  int agent_ = 0;
  Edge first_ = 0;
  Edge edge_ = 0;  // next
  Edge end_ = 0;
  Eta best_{};
  std::array<Eta, limits::kNeighbours> etas_{};
};

}  // namespace ivo::planner
