#include "firmware/loop/scheduler.hpp"

namespace ivo::firmware {

std::int64_t Scheduler::advance(Instant now) noexcept {
  deadline_ += period_;
  if (now <= deadline_) {
    return 0;
  }
  // The next deadline is the first in phase that is still ahead: catching up would send two velocities in one period.
  const std::int64_t late = (now - deadline_ + period_ - Duration(1)) / period_;
  deadline_ += late * period_;
  skipped_ += static_cast<std::uint64_t>(late);
  return late;
}

}  // namespace ivo::firmware
