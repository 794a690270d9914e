// Is this a real-time kernel, on hardware, with a clock that is fast to read?
#pragma once

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

[[nodiscard]] Group kernel_checks(const MachineFiles& files);

}  // namespace ivo::firmware::doctor
