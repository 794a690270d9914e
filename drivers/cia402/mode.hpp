// Modes of operation 6060h, of which the product uses the two for velocity.
#pragma once

#include <cstdint>
#include <optional>

namespace ivo::drivers::cia402 {

enum class Mode : std::int8_t { kProfileVelocity = 3, kCyclicSynchronousVelocity = 9 };

/// The velocity mode to use of those that 6502h offers (bit n-1 is mode n): cyclic synchronous where there is a choice.
[[nodiscard]] constexpr std::optional<Mode> velocity_mode(std::uint32_t supported_modes) noexcept {
  for (const Mode mode : {Mode::kCyclicSynchronousVelocity, Mode::kProfileVelocity}) {
    if ((supported_modes >> (static_cast<int>(mode) - 1) & 1) != 0) {
      return mode;
    }
  }
  return std::nullopt;
}

}  // namespace ivo::drivers::cia402
