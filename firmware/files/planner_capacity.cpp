#include "firmware/files/planner_capacity.hpp"

#include "config/limits.hpp"

namespace ivo::firmware {

std::string profile_that_fits(double value, const Capacity& capacity) {
  const char* const fits = value <= capacity.micro     ? limits::Micro::kName
                           : value <= capacity.onboard ? limits::Onboard::kName
                           : value <= capacity.desktop ? limits::Desktop::kName
                                                       : nullptr;
  return fits != nullptr ? std::string("the planner profile that fits is ") + fits + " (-DIVO_PLANNER_PROFILE)"
                         : std::string("no planner profile is that large");
}

}  // namespace ivo::firmware
