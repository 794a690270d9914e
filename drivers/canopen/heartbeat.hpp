// Heartbeat, both ends (CiA 301, 7.2.8.3.2).
#pragma once

#include <algorithm>
#include <optional>

#include "config/base/time.hpp"
#include "drivers/canopen/nmt.hpp"

namespace ivo::drivers {

/// Says when a heartbeat is due: at once, then every period, keeping phase. A late caller skips periods, it never
/// bursts.
class HeartbeatProducer {
 public:
  explicit constexpr HeartbeatProducer(Duration period) noexcept : period_(period) {}

  /// True once for each heartbeat that is to be sent.
  [[nodiscard]] constexpr bool due(Instant now) noexcept {
    if (next_.has_value() && now < *next_) {
      return false;
    }
    next_ = next_.has_value() && now < *next_ + period_ ? *next_ + period_ : now + period_;
    return true;
  }

 private:
  Duration period_;
  std::optional<Instant> next_;
};

/// Watches one node. It begins with the first heartbeat: a node that never spoke is the boot time-out's matter.
class HeartbeatConsumer {
 public:
  explicit constexpr HeartbeatConsumer(Duration timeout) noexcept : timeout_(timeout) {}

  constexpr void heard(Instant now) noexcept { last_ = now; }
  constexpr void forget() noexcept { last_.reset(); }
  [[nodiscard]] constexpr bool lost(Instant now) const noexcept { return last_.has_value() && now - *last_ > timeout_; }

 private:
  Duration timeout_;
  std::optional<Instant> last_;
};

}  // namespace ivo::drivers
