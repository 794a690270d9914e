// From a prior and the agents' preferred areas to what each agent is asked to search: the sub-priors (Eq. 10; model.md,
// "Sub-priors").
#pragma once

#include <array>
#include <limits>
#include <span>

#include "config/base/static_vector.hpp"
#include "planner/refusal.hpp"
#include "planner/search/belief.hpp"
#include "planner/world/polygon.hpp"
#include "planner/world/sight_table.hpp"

namespace ivo::planner {

using PreferredAreas = StaticVector<Areas, limits::kAgents>;

/// From raw masses, one a cell and not normalised: belief.mass with sum 1 over the observable cells and 0 elsewhere,
/// the list of cells with mass, and the unobservable share. A cell with less than 1e-5 of the mean, or than 2^-32 of
/// all, counts as empty: of the whole that is less than 1e-5, or 1e-3 on the largest maps. Refuses a mass below 0, one
/// that is not finite, and an agent that can observe no mass. Cost: the cells.
[[nodiscard]] Refusal normalise(const Cells& cells, const SightTable& sight, int agents, std::span<const double> raw,
                                Belief& belief) noexcept;

/// A cell preferred by some agents goes to them in equal parts; a cell preferred by nobody goes in equal parts to the
/// agents that stated no preference, or to all if every agent stated one. Shares count what the agent can observe; each
/// is scaled to 1/M. An agent left without mass gets p/M, and `left_without` says so. Without any area there are no
/// sub-priors. Refuses an area that covers no mass its agent can observe. Cost: cells times areas.
[[nodiscard]] Refusal divide(const Cells& cells, const SightTable& sight, const PreferredAreas& preferred,
                             Belief& belief, AgentSet& left_without) noexcept;

/// p_m of one agent from shares of any scale, `sum` their sum over the cells with mass: scaled to 1/M; p/M when there
/// is none, and `left_without` says so. Cost: the cells with mass.
template <class ShareOf>
void fill_sub_prior(int agent, double sum, Belief& belief, AgentSet& left_without, ShareOf&& share_of) noexcept {
  const bool none = sum < std::numeric_limits<double>::min();  // of less, the scale would be infinite
  if (none) {
    left_without = static_cast<AgentSet>(left_without | agent_bit(agent));
  }
  const double scale = none ? 1.0 / belief.agents : 1.0 / sum / belief.agents;
  Mass sum_of_agent{};
  MassRounding rounding;
  for (const Cell c : belief.cells_with_mass()) {
    const double share = none ? to_double(belief.mass[index(c)]) : share_of(c);
    const Mass mass = rounding.round(share * scale);
    belief.sub_mass[index(agent)][index(c)] = mass;
    sum_of_agent += mass;
  }
  belief.sub_whole = agent == 0 ? sum_of_agent : belief.sub_whole + sum_of_agent;
}

}  // namespace ivo::planner
