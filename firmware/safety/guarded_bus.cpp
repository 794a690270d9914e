#include "firmware/safety/guarded_bus.hpp"

#include <numeric>

namespace ivo::firmware {

std::size_t GuardedBus::receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept {
  // Reading the bus begins a new cycle: what the last one permitted is over.
  permit_motion(false);
  return inner_.receive(frames, now);
}

std::size_t GuardedBus::send(std::span<const hal::CanFrame> frames, Instant now) noexcept {
  // Runs of good frames go on as they lie, so a span without a refusal is one call of the inner bus, without a copy.
  std::size_t taken = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (passes(frames[i])) {
      continue;
    }
    if (i > begin) {
      taken += inner_.send(frames.subspan(begin, i - begin), now);
    }
    begin = i + 1;
  }
  // Also with nothing left to send: what waits in the inner bus leaves with a later call of it.
  return taken + inner_.send(frames.subspan(begin), now);
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
