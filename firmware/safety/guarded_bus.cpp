#include "firmware/safety/guarded_bus.hpp"

#include <algorithm>
#include <numeric>

namespace ivo::firmware {

std::size_t GuardedBus::receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept {
  // Reading the bus begins a new cycle: what the last one permitted is over.
  permit_motion(false);
  return inner_.receive(frames, now);
}

std::size_t GuardedBus::send(std::span<const hal::CanFrame> frames, Instant now) noexcept {
  std::size_t taken = 0;
  for (; frames.size() > passing_.size(); frames = frames.subspan(passing_.size())) {
    taken += send_part(frames.first(passing_.size()), now);
  }
  return taken + send_part(frames, now);
}

std::size_t GuardedBus::send_part(std::span<const hal::CanFrame> frames, Instant now) noexcept {
  // Four wheels move together or not at all: one that may not keeps the others from it.
  std::size_t passed = 0;
  bool motion_refused = false;
  for (const hal::CanFrame& frame : frames) {
    const MotionWays moved = rules_.moved_by(frame);
    const FrameRefusal refusal = judge(frame, moved);
    if (refusal == FrameRefusal::kNone) {
      passing_[passed++] = frame;
    } else {
      refuse(frame, refusal);
      motion_refused = motion_refused || moved != 0;
    }
  }
  if (motion_refused) {
    const auto moves = [this](const hal::CanFrame& frame) {
      const bool refused = rules_.moved_by(frame) != 0;
      if (refused) {
        refuse(frame, FrameRefusal::kNotWithTheOthers);
      }
      return refused;
    };
    const auto end = std::remove_if(passing_.begin(), passing_.begin() + static_cast<std::ptrdiff_t>(passed), moves);
    passed = static_cast<std::size_t>(end - passing_.begin());
  }
  // Also with nothing left to send: what waits in the inner bus leaves with a later call of it.
  return inner_.send(std::span<const hal::CanFrame>(passing_).first(passed), now);
}

hal::BusCounters GuardedBus::counters() const noexcept {
  hal::BusCounters counters = inner_.counters();
  counters.send_refused += refused();
  return counters;
}

std::uint64_t GuardedBus::refused(FrameRefusal reason) const noexcept {
  return refused_[static_cast<std::size_t>(reason)];
}

std::uint64_t GuardedBus::refused() const noexcept {
  return std::accumulate(refused_.begin(), refused_.end(), std::uint64_t{0});
}

FrameRefusal GuardedBus::judge(const hal::CanFrame& frame, MotionWays moved) noexcept {
  const bool permitted = moved != 0 ? (moved & ~permits_) == 0 : in_motion_;
  const FrameRefusal refusal = rules_.judge(frame, permitted);
  if (refusal == FrameRefusal::kNone) {
    permits_ = static_cast<MotionWays>(permits_ & ~moved);
  }
  return refusal;
}

void GuardedBus::refuse(const hal::CanFrame& frame, FrameRefusal refusal) noexcept {
  ++refused_[static_cast<std::size_t>(refusal)];
  last_refused_id_ = frame.id;
}

}  // namespace ivo::firmware
