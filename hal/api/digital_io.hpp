// Emergency stop and bumpers as the loop sees them: a byte, how old it is, and whether it was ever read.
#pragma once

#include <cstddef>
#include <cstdint>

#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::hal {

/// Bit 0 is the emergency stop, bit n the nth bumper. A set bit is an input that is pressed, whatever its level.
inline constexpr std::size_t kDigitalInputs = 1 + kBumpers;
static_assert(kDigitalInputs == 8, "a byte");

/// Without being told otherwise everything is pressed.
struct DigitalSnapshot {
  std::uint8_t pressed = 0xFF;     ///< now, or at any time since the last snapshot; inputs that are not fitted are 0
  Duration age = Duration::max();  ///< of the last whole reading; not below 0
  bool valid = false;              ///< false: there was none yet
};

class DigitalInputs {
 public:
  virtual ~DigitalInputs() = default;

  /// The loop's thread alone: a press between two calls, however short, is in the second. Never waits; no system call.
  [[nodiscard]] virtual DigitalSnapshot snapshot(Instant now) noexcept = 0;
};

}  // namespace ivo::hal
