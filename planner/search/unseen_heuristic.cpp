#include "planner/search/unseen_heuristic.hpp"

#include <algorithm>
#include <bit>

#include "planner/numeric/lattice.hpp"
#include "planner/search/work.hpp"

namespace ivo::planner {

int UnseenMass::advance(const SeenMap& seen, int rows) noexcept {
  const Belief& belief = world_.belief;
  const bool alike = !belief.has_sub_priors && belief.alike > Mass{};
  const auto& mass = belief.has_sub_priors ? belief.sub_mass[index(agent_)] : belief.mass;
  Mass unseen{};
  int work = 0;
  while (!walk_.done() && work < rows) {
    const auto [swath, words, ends_swath] = walk_.next(world_.sight, std::min(rows - work, work::kRowsAtOnce));
    int cells = 0;
    for (int i = 0; i < swath.rows; ++i) {
      const std::uint64_t fresh = words[i] & ~seen.window(swath.first_row + i, swath.first_byte);
      cells += std::popcount(fresh);
      if (!alike) {
        const Cell first = seen.cell(swath.first_row + i, swath.first_byte, 0);
        for_each_bit(fresh, [&](int bit) { unseen += mass[index(first + bit)]; });
      }
    }
    if (alike) {
      unseen += belief.alike * cells;
      cells = 0;
    }
    work += work::rows_shown(swath.rows, cells);
  }
  mass_ += unseen;
  return work;
}

Eta eta_of(Mass mass, double length_m) noexcept {
  const double at_least_m = std::max(length_m, 1.0 / kTicksAMetre);
#if IVO_PLANNER_FIXED
  const auto ticks = static_cast<std::uint64_t>(at_least_m * kTicksAMetre);
  return (static_cast<std::uint64_t>(std::max(mass, Mass{}).raw()) << 12U) / std::max<std::uint64_t>(1, ticks);
#else
  return mass / at_least_m;
#endif
}

void UnseenHeuristic::begin(int agent, Node here) noexcept {
  agent_ = agent;
  first_ = edge_ = world_.graph.first_edge(here);
  end_ = world_.graph.end_edge(here);
  weighing_ = false;
  best_ = Eta{};
  etas_.fill(Eta{});
}

int UnseenHeuristic::weigh(const SeenMap& seen, int rows) noexcept {
  if (!weighing_) {
    shown_.begin(agent_, world_.sight.along_edge(agent_, edge_));
    weighing_ = true;
  }
  const int work = shown_.advance(seen, rows);
  if (shown_.done()) {
    const Eta eta = eta_of(shown_.mass(), world_.graph.length_m(edge_));
    etas_[index(edge_ - first_)] = eta;
    best_ = std::max(best_, eta);
    weighing_ = false;
    ++edge_;
  }
  return work;
}

Visibility UnseenHeuristic::visibility(Edge e, int beta) const noexcept {
  const Eta eta = etas_[index(e - first_)];
  return eta > Eta{} ? visibility_of(eta, best_, beta) : Visibility{};
}

}  // namespace ivo::planner
