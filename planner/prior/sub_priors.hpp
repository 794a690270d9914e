// Sub-priors that are given, not derived from preferred areas (Eq. 10; model.md, "Sub-priors").
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "planner/prior/prior.hpp"
#include "planner/refusal.hpp"
#include "planner/search/belief.hpp"
#include "planner/world/sight_table.hpp"

namespace ivo::planner {

/// p/M to each (Table I, U/S).
struct AlikeSubPriors {};
/// Each component of a Gaussian mixture prior to an agent (Table I, G/S).
struct DealtComponents {
  std::span<const std::int8_t> agent_of_component;
};
/// One image an agent; what it puts where the prior has nothing is left out.
struct SubPriorImages {
  std::span<const GreyView> of_agent;
};
/// monostate: from the agents' preferred areas (preferences.hpp).
using SubPriorChoice = std::variant<std::monostate, AlikeSubPriors, DealtComponents, SubPriorImages>;

/// The agent whose start is nearest to the component's mean, the lowest on a tie: the dealing of Table I.
[[nodiscard]] std::int8_t nearest_agent(const GaussianComponent& component, std::span<const Point> starts) noexcept;

/// Fills belief.sub_mass from the choice, which must not be monostate and must fit the prior and the agents
/// (problem_checks.hpp). Each counts what its agent can observe and is scaled to 1/M; an agent left without mass gets
/// p/M, and `left_without` says so. Refuses a sub-prior whose sum is not finite. Cost: cells times agents, and
/// components.
[[nodiscard]] Refusal give_sub_priors(const Cells& cells, const SightTable& sight, const SubPriorChoice& choice,
                                      std::span<const GaussianComponent> components, Belief& belief,
                                      AgentSet& left_without) noexcept;

}  // namespace ivo::planner
