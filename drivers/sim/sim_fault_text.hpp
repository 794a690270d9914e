// The names of the faults, as scripts have them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "drivers/sim/sim_fault.hpp"

namespace ivo::drivers {

/// By SimFault: "silent", "no_heartbeat" ...
[[nodiscard]] std::span<const std::string_view> sim_fault_names() noexcept;
[[nodiscard]] std::string_view name_of(SimFault fault) noexcept;
[[nodiscard]] std::optional<SimFault> sim_fault_of(std::string_view name) noexcept;

}  // namespace ivo::drivers
