// Which interrupts run on the loop's CPU?
#pragma once

#include <vector>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

/// Of those that somebody handles. `all`: the CPUs that are there.
[[nodiscard]] Finding interrupts(const MachineFiles& files, const std::vector<int>& all, int cpu);

}  // namespace ivo::firmware::doctor
