#include "firmware/loop/scheduler.hpp"

#include <algorithm>

namespace ivo::firmware {

std::int64_t Scheduler::advance(Instant started, Instant ended) noexcept {
  deadline_ += period_;
  // The next deadline is the first in phase that is still ahead and no closer to a late start than half a period:
  // drives that act on SYNC must not get two in a row, and catching up would send them.
  const Instant earliest = std::max(ended, started + period_ / 2);
  if (earliest <= deadline_) {
    return 0;
  }
  const std::int64_t late = (earliest - deadline_ + period_ - Duration(1)) / period_;
  deadline_ += late * period_;
  skipped_ += static_cast<std::uint64_t>(late);
  return late;
}

}  // namespace ivo::firmware
