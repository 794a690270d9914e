// What a plan is worth and how good that can be, as files say it.
#pragma once

#include <array>
#include <optional>

#include "config/semantic_class.hpp"
#include "firmware/files/json_value.hpp"

namespace ivo::firmware {

/// As files spell AgentKind.
inline constexpr std::array<const char*, kAgentKinds> kAgentKindWords = {"robot", "person"};

/// As planner::PlanScore defines them.
struct ScoreDocument {
  double expected_time_s = 0.0;
  double expected_time_continuous_s = 0.0;
  std::optional<double> expected_sub_prior_time_s;  ///< none without sub-priors
  double unseen_mass = 1.0;
  double horizon_s = 0.0;
  bool complete = false;
  std::optional<double> expected_sub_prior_time_own_s = {};  ///< own reading; only where it was asked for
};

/// Least expected times, ET_c, of any plan that leaves as much unseen, as planner::Bounds defines them, and how far
/// above the larger nominal one the plan is.
struct BoundsDocument {
  double area_s = 0.0;
  double area_strict_s = 0.0;
  double reach_s = 0.0;
  double reach_strict_s = 0.0;
  std::optional<double> gap;  ///< ET_c / bound - 1; none where the bound is 0
};

[[nodiscard]] Json json_of(const ScoreDocument& score);
/// Without the gap, which files keep beside it.
[[nodiscard]] Json json_of(const BoundsDocument& bounds);

}  // namespace ivo::firmware
