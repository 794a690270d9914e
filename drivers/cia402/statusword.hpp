// The power state that a statusword 6041h tells (CiA 402-2, 6.2).
#pragma once

#include <cstdint>

namespace ivo::drivers::cia402 {

enum class PowerState : std::uint8_t {
  kNotReadyToSwitchOn,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReactionActive,
  kFault,
  kUnknown,  ///< a pattern that the standard does not define
};

/// Four states ignore the quick-stop bit (mask 4Fh), the other four need it (mask 6Fh).
[[nodiscard]] PowerState power_state(std::uint16_t statusword) noexcept;

/// The bits of the statusword by which `state`, not kUnknown, is told; what a drive puts there.
[[nodiscard]] std::uint16_t statusword_bits(PowerState state) noexcept;

}  // namespace ivo::drivers::cia402
