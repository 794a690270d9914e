// The controlword 6040h (CiA 402-2, 6.1): one transition at a time towards a wished state.
#pragma once

#include <cstdint>

#include "drivers/cia402/statusword.hpp"

namespace ivo::drivers::cia402 {

namespace controlword {
inline constexpr std::uint16_t kDisableVoltage = 0x00;
inline constexpr std::uint16_t kQuickStop = 0x02;
inline constexpr std::uint16_t kShutdown = 0x06;
inline constexpr std::uint16_t kSwitchOn = 0x07;
inline constexpr std::uint16_t kEnableOperation = 0x0F;
inline constexpr std::uint16_t kFaultReset =
    0x80;  // acts on the rising edge of bit 7: any other word above comes before it
}  // namespace controlword

/// The word that takes a drive in state `now` one transition towards `goal` (kReadyToSwitchOn, kSwitchedOn or
/// kOperationEnabled), or keeps it there. From a state with no way (fault, not ready) it is kDisableVoltage, which asks
/// for nothing. Quick Stop Active is left through Switch On Disabled: motion never resumes by transition 16.
[[nodiscard]] std::uint16_t toward(PowerState now, PowerState goal) noexcept;

}  // namespace ivo::drivers::cia402
