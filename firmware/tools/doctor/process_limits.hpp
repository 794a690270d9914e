// What the kernel lets this process do, as /proc/self tells it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

struct Limit {
  bool unlimited = false;
  std::uint64_t value = 0;
  [[nodiscard]] bool allows(std::uint64_t wanted) const noexcept { return unlimited || value >= wanted; }
};

/// The soft limit that /proc/self/limits has under `name`, as "Max locked memory"; none where it is not told.
[[nodiscard]] std::optional<Limit> limit_called(const std::string& name, const MachineFiles& files);

/// Numbers of capabilities (linux/capability.h).
inline constexpr unsigned kCapIpcLock = 14;  ///< memory locked without limit
inline constexpr unsigned kCapSysNice = 23;  ///< any priority
/// Whether the process has it in effect, by /proc/self/status.
[[nodiscard]] bool has_capability(unsigned number, const MachineFiles& files);

}  // namespace ivo::firmware::doctor
