// Can all that the controller needs be kept in memory?
#pragma once

#include <cstdint>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

/// Beside the planner's object: program, libraries, maps and pictures, the stacks of threads. Locking counts what is
/// reserved, used or not.
inline constexpr std::uint64_t kBytesBesidePlanner = std::uint64_t{128} << 20U;

/// `needed`: bytes that the controller locks.
[[nodiscard]] Group memory_checks(const MachineFiles& files, std::uint64_t needed);

}  // namespace ivo::firmware::doctor
