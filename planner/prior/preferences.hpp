// From a prior and the agents' preferred areas to what each agent is asked to search: the sub-priors (Eq. 10; model.md,
// "Sub-priors").
#pragma once

#include <array>

#include "config/base/static_vector.hpp"
#include "planner/refusal.hpp"
#include "planner/search/belief.hpp"
#include "planner/world/polygon.hpp"
#include "planner/world/sight_table.hpp"

namespace ivo::planner {

using PreferredAreas = StaticVector<Areas, limits::kAgents>;

/// Scales belief.mass to sum 1 over the observable cells, sets it 0 elsewhere, lists the cells with mass and reports
/// the unobservable share. Refuses an agent that can observe no mass. Cost: the cells.
[[nodiscard]] Refusal normalise(const SightTable& sight, int cells, int agents, Belief& belief) noexcept;

/// A cell preferred by some agents goes to them in equal parts; a cell preferred by nobody goes in equal parts to the
/// agents that stated no preference, or to all if every agent stated one. Shares count what the agent can observe; each
/// is scaled to 1/M. An agent left without mass gets p/M, and `left_without` says so. Without any area there are no
/// sub-priors. Refuses an area that covers no mass its agent can observe. Cost: cells times areas.
[[nodiscard]] Refusal divide(const Cells& cells, const SightTable& sight, const PreferredAreas& preferred,
                             Belief& belief, AgentSet& left_without) noexcept;

/// Sub-priors that were given: belief.sub_mass as filled, one an agent, becomes what the agent can observe of it,
/// scaled to 1/M. An agent left without mass gets p/M, and `left_without` says so. Cost: cells times agents.
void deal(const SightTable& sight, Belief& belief, AgentSet& left_without) noexcept;

}  // namespace ivo::planner
