// When the next cycle is due, and what happens when one was late: whole periods are skipped, the phase is kept, the
// loss is counted.
#pragma once

#include <cstdint>

#include "config/base/time.hpp"

namespace ivo::firmware {

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

}  // namespace ivo::firmware
