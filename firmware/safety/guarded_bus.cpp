#include "firmware/safety/guarded_bus.hpp"

#include <numeric>

namespace ivo::firmware {

std::size_t GuardedBus::receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept {
  // Reading the bus begins a new cycle: what the last one permitted is over.
  permit_motion(false);
  return inner_.receive(frames, now);
}

std::size_t GuardedBus::send(std::span<const hal::CanFrame> frames, Instant now) noexcept {
  // One call of the inner bus, also with nothing to say: what waits there may be due. More frames than one cycle has
  // are several calls.
  std::size_t taken = 0;
  passed_.clear();
  for (const hal::CanFrame& frame : frames) {
    if (!passes(frame)) {
      continue;
    }
    if (passed_.full()) {
      taken += inner_.send(passed_.span(), now);
      passed_.clear();
    }
    (void)passed_.push_back(frame);
  }
  return taken + inner_.send(passed_.span(), now);
}

std::uint64_t GuardedBus::refused(FrameRefusal reason) const noexcept {
  return refused_[static_cast<std::size_t>(reason)];
}

std::uint64_t GuardedBus::refused() const noexcept {
  return std::accumulate(refused_.begin(), refused_.end(), std::uint64_t{0});
}

bool GuardedBus::passes(const hal::CanFrame& frame) noexcept {
  const MotionWays moved = rules_.moved_by(frame);
  const bool permitted = moved != 0 ? (moved & ~permits_) == 0 : in_motion_;
  const FrameRefusal refusal = rules_.judge(frame, permitted);
  if (refusal != FrameRefusal::kNone) {
    ++refused_[static_cast<std::size_t>(refusal)];
    last_refused_id_ = frame.id;
    return false;
  }
  permits_ = static_cast<MotionWays>(permits_ & ~moved);
  return true;
}

}  // namespace ivo::firmware
