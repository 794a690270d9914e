// Which build of the product is large enough for what this one refuses.
#pragma once

#include <string>

namespace ivo::firmware {

/// The capacity in question, as each profile of the planner has it (config/limits.hpp).
struct Capacity {
  double micro = 0.0;
  double onboard = 0.0;
  double desktop = 0.0;
};

/// "the planner profile that fits is NAME (-DIVO_PLANNER_PROFILE)", or that none does.
[[nodiscard]] std::string profile_that_fits(double value, const Capacity& capacity);

}  // namespace ivo::firmware
