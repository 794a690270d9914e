// Where the loop's time comes from.
#pragma once

#include "config/base/time.hpp"

namespace ivo::hal {

class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual Instant now() noexcept = 0;
  /// Returns at or after `deadline`; at once when it is past.
  virtual void sleep_until(Instant deadline) noexcept = 0;
};

}  // namespace ivo::hal
