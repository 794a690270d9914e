// What cycles cost, by phase, and how late they woke; and the watch that measures it.
#pragma once

#include <array>
#include <cstdint>

#include "config/base/time.hpp"
#include "config/base/time_histogram.hpp"
#include "firmware/loop/phase.hpp"
#include "firmware/record/tracer.hpp"
#include "hal/api/clock.hpp"

namespace ivo::firmware {

/// 25 kB.
struct PhaseTimes {
  std::array<TimeHistogram, kPhases> phases;
  TimeHistogram cycle;    ///< all ten
  TimeHistogram wake_up;  ///< from the deadline to the cycle's begin; of real time alone
  [[nodiscard]] const TimeHistogram& of(Phase phase) const noexcept { return phases[static_cast<std::size_t>(phase)]; }
};

/// Reads a clock at the end of each phase; one begins where the one before it ended. Without a clock it does nothing.
class PhaseWatch {
 public:
  /// In scope while its phase lasts.
  class Lap {
   public:
    Lap(PhaseWatch& watch, Phase phase) noexcept : watch_(watch), phase_(phase) {}
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;
    ~Lap() { watch_.lap(phase_); }

   private:
    PhaseWatch& watch_;
    Phase phase_;
  };

  /// `stopwatch` may be null; both outlive this. What is measured is traced too.
  PhaseWatch(hal::Clock* stopwatch, Tracer& tracer) noexcept : stopwatch_(stopwatch), tracer_(tracer) {}

  void begin() noexcept {
    if (stopwatch_ != nullptr) {
      begin_ = last_ = stopwatch_->now();
    }
  }
  void end(Duration woke_late) noexcept {
    if (stopwatch_ != nullptr) {
      times_.cycle.add(last_ - begin_);
      times_.wake_up.add(woke_late);
    }
  }

  [[nodiscard]] hal::Clock* stopwatch() const noexcept { return stopwatch_; }
  /// Of the cycle under way.
  [[nodiscard]] Instant began() const noexcept { return begin_; }
  [[nodiscard]] const PhaseTimes& times() const noexcept { return times_; }

 private:
  void lap(Phase phase) noexcept {
    if (stopwatch_ != nullptr) {
      const Instant now = stopwatch_->now();
      times_.phases[static_cast<std::size_t>(phase)].add(now - last_);
      tracer_.phase(static_cast<std::uint8_t>(phase), last_, now);
      last_ = now;
    }
  }

  hal::Clock* stopwatch_;
  Tracer& tracer_;
  Instant begin_{};
  Instant last_{};
  PhaseTimes times_;
};

}  // namespace ivo::firmware
