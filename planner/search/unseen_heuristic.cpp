#include "planner/search/unseen_heuristic.hpp"

#include <algorithm>

#include "planner/numeric/lattice.hpp"
#include "planner/search/work.hpp"

namespace ivo::planner {

void UnseenHeuristic::begin(int agent, Node here) noexcept {
  agent_ = agent;
  first_ = edge_ = world_.graph.first_edge(here);
  end_ = std::min<Edge>(world_.graph.end_edge(here), first_ + kNeighbours);
  best_ = Eta{};
  etas_.fill(Eta{});
}

void UnseenHeuristic::weigh(const SeenMap& seen, int& work) noexcept {
  const Belief& belief = world_.belief;
  const bool sub_priors = belief.has_sub_priors;
  Mass gain{};
  for (const Swath& swath : world_.sight.along_edge(agent_, edge_).swaths) {
    const std::uint64_t* const words = world_.sight.words(swath);
    int cells = 0;
    for (int i = 0; i < swath.rows; ++i) {
      const std::uint64_t fresh = words[i] & ~seen.window(swath.first_row + i, swath.first_byte);
      cells += std::popcount(fresh);
      if (!sub_priors && belief.alike > Mass{}) {
        continue;
      }
      const auto& mass = sub_priors ? belief.sub_mass[index(agent_)] : belief.mass;
      const Cell first = seen.cell(swath.first_row + i, swath.first_byte, 0);
      for_each_bit(fresh, [&](int bit) { gain += mass[index(first + bit)]; });
    }
    if (!sub_priors && belief.alike > Mass{}) {
      gain += belief.alike * cells;
      cells = 0;
    }
    work += work::rows_shown(swath.rows, cells);
  }
  const double length_m = std::max(world_.graph.length_m(edge_), 1.0 / kTicksAMetre);
#if IVO_PLANNER_FIXED
  const auto ticks = static_cast<std::uint64_t>(length_m * kTicksAMetre);
  const Eta eta = (static_cast<std::uint64_t>(std::max(gain, Mass{}).raw()) << 12U) / std::max<std::uint64_t>(1, ticks);
#else
  const Eta eta = gain / length_m;
#endif
  etas_[index(edge_ - first_)] = eta;
  best_ = std::max(best_, eta);
}

Visibility UnseenHeuristic::visibility(Edge e, int beta) const noexcept {
  if (e >= end_ || best_ <= Eta{}) {
    return Visibility{};
  }
  const Eta eta = etas_[index(e - first_)];
#if IVO_PLANNER_FIXED
  const std::uint64_t ratio = (eta << 16U) / best_;
  std::uint64_t power = 1U << 16U;
  for (int k = 0; k < beta; ++k) {
    power = power * ratio >> 16U;
  }
  return eta > 0 ? static_cast<Visibility>(std::max<std::uint64_t>(1, power << (kVisibilityBits - 16))) : Visibility{};
#else
  const double ratio = eta / best_;
  double power = 1.0;
  for (int k = 0; k < beta; ++k) {
    power *= ratio;
  }
  return power;
#endif
}

}  // namespace ivo::planner
