// Two devices on one node-id, told by the rhythm of their heartbeats: together they beat twice a period.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "config/base/time.hpp"

namespace ivo::drivers {

/// Two producers of one period beat in turns, so every second gap is at most half a period. One early beat is nothing:
/// a node also beats when its NMT state changes.
class HeartbeatRhythm {
 public:
  explicit constexpr HeartbeatRhythm(Duration period) noexcept : early_below_(period * 3 / 5) {}

  constexpr void forget() noexcept {
    last_.reset();
    early_ = 0;
  }
  constexpr void heard(Instant at) noexcept {
    const bool early = last_.has_value() && at - *last_ < early_below_;
    early_ = static_cast<std::uint8_t>(early_ << 1 | (early ? 1 : 0));
    last_ = at;
  }
  /// Three of the last eight beats came early.
  [[nodiscard]] constexpr bool twins() const noexcept { return std::popcount(early_) >= 3; }

 private:
  Duration early_below_;
  std::optional<Instant> last_;
  std::uint8_t early_ = 0;  // a bit a beat
};

}  // namespace ivo::drivers
