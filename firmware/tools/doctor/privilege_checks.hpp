// May the loop's thread run before all others, and for how long?
#pragma once

#include <string>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

/// Whether a thread of this process could become a real-time one. Limits alone do not tell: containers refuse what they
/// allow.
struct PriorityTrial {
  int priority = 0;       ///< SCHED_FIFO that was tried
  std::string refusal{};  ///< what was said in refusing it; empty: it was granted
};

[[nodiscard]] Group privilege_checks(const MachineFiles& files, const PriorityTrial& trial);

}  // namespace ivo::firmware::doctor
