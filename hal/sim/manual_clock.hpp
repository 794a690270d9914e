// Time that moves only when it is told to.
#pragma once

#include <algorithm>

#include "hal/api/clock.hpp"

namespace ivo::hal {

/// Starts at 0. Single-threaded.
class ManualClock final : public Clock {
 public:
  [[nodiscard]] Instant now() noexcept override { return now_; }
  /// Now is `deadline` at once; a deadline in the past changes nothing.
  void sleep_until(Instant deadline) noexcept override { now_ = std::max(now_, deadline); }

 private:
  Instant now_{};
};

}  // namespace ivo::hal
