// Something that a simulated device does every so often, as long as it is asked for.
#pragma once

#include <optional>

#include "config/base/time.hpp"

namespace ivo::drivers {

class SimPeriod {
 public:
  /// How often it is due: at once when it was not asked for, then each `period`, up to `most` a call; what is missed
  /// beyond is skipped.
  [[nodiscard]] int due(Instant now, Duration period, int most) noexcept {
    int times = 0;
    next_ = next_.value_or(now);
    while (*next_ <= now && times < most) {
      *next_ += period;
      ++times;
    }
    next_ = *next_ <= now ? now + period : *next_;
    return times;
  }
  void stop() noexcept { next_.reset(); }

 private:
  std::optional<Instant> next_;
};

}  // namespace ivo::drivers
