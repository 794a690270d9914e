// What happens when a cycle is late. Whole periods are skipped and the phase is kept (Scheduler): drives that act on
// SYNC never get two in a row. One lost period is held: the drives go on with the last command. So many soon one after
// the other ramp the robot down, so many more are a fault that only an operator clears (OverrunPolicy).
#pragma once

#include <cstdint>

#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::firmware {

/// When the next cycle is due.
class Scheduler {
 public:
  Scheduler(Instant first, Duration period) noexcept : deadline_(first), period_(period) {}

  /// Of the cycle that comes next.
  [[nodiscard]] Instant deadline() const noexcept { return deadline_; }
  /// Periods in which no cycle ran because the one before was late.
  [[nodiscard]] std::uint64_t skipped() const noexcept { return skipped_; }

  /// The cycle ran from `started` to `ended`. Returns the periods that are lost with it; 0 when it was in time.
  std::int64_t advance(Instant started, Instant ended) noexcept;

 private:
  Instant deadline_;
  Duration period_;
  std::uint64_t skipped_ = 0;
};

enum class Lateness : std::uint8_t {
  kInTime,    ///< no lost period is remembered
  kHeld,      ///< one or a few: nothing is done but that the velocity does not jump
  kRampDown,  ///< LoopParameters::ramp_down_at reached, and not all of them forgotten since
  kLatched,   ///< LoopParameters::latch_at reached: in this cycle, and it is for the caller to keep
};

/// Judges lost periods. A cycle in time makes one twentieth of a lost period forgotten.
class OverrunPolicy {
 public:
  /// `counts_only`: the bus is simulated, and a busy host says nothing about a robot: never beyond kHeld.
  OverrunPolicy(const LoopParameters& parameters, bool counts_only) noexcept
      : ramp_down_at_(parameters.ramp_down_at), latch_at_(parameters.latch_at), counts_only_(counts_only) {}

  /// Once a cycle. `lost`: periods without a cycle just before it. What was lost while nothing `may_move` is not held
  /// against the cycles after.
  Lateness judge(std::int64_t lost, bool may_move) noexcept;
  [[nodiscard]] Lateness lateness() const noexcept { return lateness_; }

 private:
  [[nodiscard]] Lateness verdict() const noexcept;

  std::int64_t ramp_down_at_;
  std::int64_t latch_at_;
  bool counts_only_;
  std::int64_t remembered_ = 0;  // kForgetPeriodIn for each lost period, one less each cycle
  Lateness lateness_ = Lateness::kInTime;
};

}  // namespace ivo::firmware
