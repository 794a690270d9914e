// A profile as tables for a person.
#pragma once

#include <string>

#include "firmware/tools/profile/cycle_profile.hpp"

namespace ivo::firmware {

struct ProfileView {
  const CycleProfile& profile;
  Duration period{};              ///< of a cycle: its budget
  double event_cost_ns = 0.0;     ///< of tracing one, as measured beside the run
  std::uint64_t events_lost = 0;  ///< by the ring
};

[[nodiscard]] std::string profile_text(const ProfileView& view);

}  // namespace ivo::firmware
