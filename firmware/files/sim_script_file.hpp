// Scripts of simulated drives: TOML into drivers/sim/sim_script.hpp.
#pragma once

#include <string>

#include "config/base/result.hpp"
#include "drivers/sim/sim_drives.hpp"

namespace ivo::firmware {

/// noise_counts, seed and coast_radps2 of all drives, and tables [[at]] in order: t_s in the drives' own time, drive
/// ("front_left" ... or "all"), fault (drivers/sim/sim_fault.hpp, in lower case), on (true where left out), value, and
/// of sdo_abort index and sub. Refuses by file, line and key.
[[nodiscard]] Result<drivers::SimDrives::Scripts> read_sim_script(const std::string& path);

}  // namespace ivo::firmware
