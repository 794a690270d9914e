// Is there room for results, and does the disk keep up?
#pragma once

#include "firmware/tools/doctor/disk_trial.hpp"
#include "firmware/tools/doctor/finding.hpp"

namespace ivo::firmware::doctor {

[[nodiscard]] Group disk_checks(const DiskFacts& facts);

}  // namespace ivo::firmware::doctor
