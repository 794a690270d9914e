// CLOCK_MONOTONIC, from 0 when constructed, running `speed` times as fast as real time.
#pragma once

#include "hal/api/clock.hpp"

namespace ivo::hal {

/// A set wall clock never moves it. Sleeping is by absolute deadline, so that lateness of one wake-up is not handed on.
class MonotonicClock final : public Clock {
 public:
  /// `speed` is above 0: 1 is real time, 10 lets ten seconds pass in one.
  explicit MonotonicClock(double speed = 1.0) noexcept;

  [[nodiscard]] Instant now() noexcept override;
  void sleep_until(Instant deadline) noexcept override;

 private:
  double speed_;
  Duration start_;
};

}  // namespace ivo::hal
