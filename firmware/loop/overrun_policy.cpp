#include "firmware/loop/overrun_policy.hpp"

#include <algorithm>

namespace ivo::firmware {
namespace {

constexpr std::int64_t kForgetPeriodIn = 20;  // cycles in time make one lost period forgotten

}  // namespace

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

Lateness OverrunPolicy::judge(std::int64_t lost, bool may_move) noexcept {
  remembered_ = std::max<std::int64_t>(0, remembered_ - 1) + kForgetPeriodIn * std::max<std::int64_t>(lost, 0);
  if (!may_move) {
    remembered_ = 0;
  }
  lateness_ = verdict();
  return lateness_;
}

Lateness OverrunPolicy::verdict() const noexcept {
  if (remembered_ == 0) {
    return Lateness::kInTime;
  }
  if (counts_only_) {
    return Lateness::kHeld;
  }
  if (remembered_ >= kForgetPeriodIn * latch_at_) {
    return Lateness::kLatched;
  }
  // A ramp goes on until all is forgotten: no stop and go.
  const bool ramping = lateness_ == Lateness::kRampDown;
  return ramping || remembered_ >= kForgetPeriodIn * ramp_down_at_ ? Lateness::kRampDown : Lateness::kHeld;
}

}  // namespace ivo::firmware
