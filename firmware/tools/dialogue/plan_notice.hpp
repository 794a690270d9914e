// Why a plan that somebody asked for at the console cannot be made, for a page to say in its own words.
#pragma once

#include <optional>
#include <string>

#include "firmware/tools/dialogue/drawn_areas.hpp"
#include "firmware/tools/planner_setup.hpp"

namespace ivo::firmware {

struct PlanNotice {
  std::string code;  ///< "area_without_mass" and the like
  std::optional<int> agent;
  std::optional<int> slot;  ///< of the area
  std::string text;         ///< one line
};

[[nodiscard]] PlanNotice notice_of(const planner::Refusal& refusal, const MissionInputs& inputs,
                                   const PreferredSlots& slots);

}  // namespace ivo::firmware
