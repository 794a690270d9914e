// Simulated time, shown at the pace of real time: for a simulated bus, where a busy host must not look like a lost
// drive.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/api/clock.hpp"
#include "hal/linux/monotonic_clock.hpp"

namespace ivo::hal {

/// now() moves only in sleep_until, and then exactly to the deadline, so a run has the same times at every pace. A host
/// that falls more than `tolerance` behind is forgiven: the pace goes on from there, and the lapse is counted.
class PacedClock final : public Clock {
 public:
  /// `speed` above 0: times real time.
  PacedClock(double speed, Duration tolerance) noexcept : host_(speed), tolerance_(tolerance) {}

  [[nodiscard]] Instant now() noexcept override { return now_; }

  void sleep_until(Instant deadline) noexcept override {
    host_.sleep_until(deadline + behind_);
    const Duration late = host_.now() - (deadline + behind_);
    if (late > tolerance_) {
      behind_ += late;
      lapses_.fetch_add(1, std::memory_order_relaxed);
    }
    now_ = deadline;
  }

  /// How often the host was late. Any thread.
  [[nodiscard]] std::uint64_t lapses() const noexcept { return lapses_.load(std::memory_order_relaxed); }

 private:
  MonotonicClock host_;
  Duration tolerance_;
  Duration behind_{};
  Instant now_{};
  std::atomic<std::uint64_t> lapses_{0};
};

}  // namespace ivo::hal
