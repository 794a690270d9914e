// How long may a CPU that sleeps take to wake up?
#pragma once

#include <vector>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

/// By the idle states of `cpus` that are enabled, and what some program holds in /dev/cpu_dma_latency, which only root
/// may read.
[[nodiscard]] Finding idle_states(const MachineFiles& files, const std::vector<int>& cpus);

}  // namespace ivo::firmware::doctor
