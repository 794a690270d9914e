#include "planner/prior/preferences.hpp"

#include <algorithm>
#include <bit>

#include "planner/numeric/index.hpp"

namespace ivo::planner {
namespace {

Refusal check_areas(const Cells& cells, const SightTable& sight, const PreferredAreas& preferred,
                    const Belief& belief) noexcept {
  for (std::size_t agent = 0; agent < preferred.size(); ++agent) {
    for (std::size_t area = 0; area < preferred[agent].size(); ++area) {
      bool covers_mass = false;
      for (const Cell c : belief.cells_with_mass()) {
        if (in(sight.observable_by(c), static_cast<int>(agent)) && contains(preferred[agent][area], cells.centre(c))) {
          covers_mass = true;
          break;
        }
      }
      if (!covers_mass) {
        return {
            .code = RefusalCode::kAreaWithoutMass, .agent = static_cast<int>(agent), .area = static_cast<int>(area)};
      }
    }
  }
  return {};
}

// Each to 1/M; who has nothing of its own searches p.
void scale(const std::array<double, limits::kAgents>& sums, Belief& belief, AgentSet& left_without) noexcept {
  for (int m = 0; m < belief.agents; ++m) {
    const bool none = sums[index(m)] <= 0.0;
    if (none) {
      left_without = static_cast<AgentSet>(left_without | agent_bit(m));
    }
    const double scale = none ? 1.0 / belief.agents : 1.0 / (belief.agents * sums[index(m)]);
    for (const Cell c : belief.cells_with_mass()) {
      const double share = none ? belief.mass[index(c)] : belief.sub_mass[index(m)][index(c)];
      belief.sub_mass[index(m)][index(c)] = share * scale;
    }
  }
}

}  // namespace

Refusal normalise(const SightTable& sight, int cells, int agents, Belief& belief) noexcept {
  double whole = 0.0;
  double observable = 0.0;
  AgentSet observers = 0;
  belief.cells = cells;
  belief.agents = agents;
  belief.mass_cell_count = 0;
  for (Cell c = 0; c < cells; ++c) {
    double& mass = belief.mass[index(c)];
    whole += mass;
    const AgentSet by = sight.observable_by(c);
    if (by == 0) {
      mass = 0.0;
    }
    if (mass > 0.0) {
      observable += mass;
      observers = static_cast<AgentSet>(observers | by);
      belief.mass_cells[index(belief.mass_cell_count++)] = c;
    }
  }
  if (whole <= 0.0) {
    return {.code = RefusalCode::kPriorWithoutMass};
  }
  for (int agent = 0; agent < agents; ++agent) {
    if (!in(observers, agent)) {
      return {.code = RefusalCode::kNoMassObservable, .agent = agent};
    }
  }
  belief.unobservable_share = 1.0 - observable / whole;
  for (const Cell c : belief.cells_with_mass()) {
    belief.mass[index(c)] /= observable;
  }
  return {};
}

Refusal divide(const Cells& cells, const SightTable& sight, const PreferredAreas& preferred, Belief& belief,
               AgentSet& left_without) noexcept {
  left_without = 0;
  AgentSet stated = 0;
  for (std::size_t m = 0; m < preferred.size(); ++m) {
    stated = static_cast<AgentSet>(stated | (preferred[m].empty() ? 0U : agent_bit(static_cast<int>(m))));
  }
  belief.has_sub_priors = stated != 0;
  if (!belief.has_sub_priors) {
    return {};
  }
  if (const Refusal refusal = check_areas(cells, sight, preferred, belief)) {
    return refusal;
  }
  const auto all = static_cast<AgentSet>((1U << static_cast<unsigned>(belief.agents)) - 1);
  const AgentSet takers_of_the_rest = stated == all ? all : static_cast<AgentSet>(all & ~stated);
  std::array<double, limits::kAgents> sums{};
  for (int m = 0; m < belief.agents; ++m) {
    std::fill_n(belief.sub_mass[index(m)].begin(), belief.cells, 0.0);  // of an earlier mission
  }
  for (const Cell c : belief.cells_with_mass()) {
    AgentSet takers = 0;
    for (int m = 0; m < belief.agents; ++m) {
      if (contains(preferred[index(m)], cells.centre(c))) {
        takers = static_cast<AgentSet>(takers | agent_bit(m));
      }
    }
    if (takers == 0) {
      takers = takers_of_the_rest;
    }
    const double part = belief.mass[index(c)] / std::popcount(takers);
    for (int m = 0; m < belief.agents; ++m) {
      const bool counts = in(takers, m) && in(sight.observable_by(c), m);
      belief.sub_mass[index(m)][index(c)] = counts ? part : 0.0;
      sums[index(m)] += counts ? part : 0.0;
    }
  }
  scale(sums, belief, left_without);
  return {};
}

void deal(const SightTable& sight, Belief& belief, AgentSet& left_without) noexcept {
  belief.has_sub_priors = true;
  left_without = 0;
  std::array<double, limits::kAgents> sums{};
  for (int m = 0; m < belief.agents; ++m) {
    for (Cell c = 0; c < belief.cells; ++c) {
      double& share = belief.sub_mass[index(m)][index(c)];
      share = belief.mass[index(c)] > 0.0 && in(sight.observable_by(c), m) ? share : 0.0;
      sums[index(m)] += share;
    }
  }
  scale(sums, belief, left_without);
}

}  // namespace ivo::planner
