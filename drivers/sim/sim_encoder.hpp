// The encoder of a simulated drive: what it shows of the motor, with noise, or stuck.
#pragma once

#include <bit>
#include <cstdint>

#include "drivers/sim/sim_motion.hpp"

namespace ivo::drivers {

class SimEncoder {
 public:
  explicit SimEncoder(std::uint32_t noise_counts, std::uint32_t seed) noexcept
      : noise_counts_(noise_counts), state_(seed != 0 ? seed : 1) {}

  /// Time went on. Stuck, it shows what it did last.
  void sample(const SimMotion& motion, bool stuck) noexcept {
    if (stuck) {
      velocity_ = 0;
      return;
    }
    position_ = static_cast<std::uint32_t>(motion.position()) + noise();
    velocity_ = motion.velocity();
  }

  [[nodiscard]] std::int32_t position() const noexcept { return std::bit_cast<std::int32_t>(position_); }
  [[nodiscard]] std::int32_t velocity() const noexcept { return velocity_; }

 private:
  /// -noise_counts_ to noise_counts_, in two's complement (xorshift32, Marsaglia 2003).
  std::uint32_t noise() noexcept {
    if (noise_counts_ == 0) {
      return 0;
    }
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_ % (2 * noise_counts_ + 1) - noise_counts_;
  }

  std::uint32_t noise_counts_;
  std::uint32_t state_;
  std::uint32_t position_ = 0;
  std::int32_t velocity_ = 0;
};

}  // namespace ivo::drivers
