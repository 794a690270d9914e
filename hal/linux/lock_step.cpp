#include "hal/linux/lock_step.hpp"

#include <algorithm>

#include "config/limits.hpp"

namespace ivo::hal {

LockStep::LockStep(SocketCanBus& bus, const Options& options) noexcept : bus_(bus), options_(options) {}

std::size_t LockStep::receive(std::span<ReceivedFrame> frames, Instant now) noexcept {
  const std::size_t count = std::min(frames.size(), queued_);
  for (std::size_t i = 0; i < count; ++i) {
    frames[i] = queue_[(first_ + i) % kQueueFrames];
    frames[i].at = now;
  }
  first_ = (first_ + count) % kQueueFrames;
  queued_ -= count;
  return count;
}

std::size_t LockStep::send(std::span<const CanFrame> frames, Instant /*now*/) noexcept {
  const std::size_t count = bus_.send(frames, host_.now());
  ever_sent_ = ever_sent_ || count > 0;
  for (const CanFrame& frame : frames.first(count)) {
    if (frame.id == options_.sync_id) {
      sync_sent_ = true;
      sync_answers_missing_ = (std::uint32_t{1} << options_.answer_ids.size()) - 1;
    }
  }
  return count;
}

BusCounters LockStep::counters() const noexcept {
  BusCounters counters = bus_.counters();
  counters.received -= overflowed_;
  counters.receive_dropped += overflowed_;
  return counters;
}

void LockStep::sleep_until(Instant deadline) noexcept {
  collect();
  Instant last_progress = host_.now();
  while (!stalled_ && !complete()) {
    const Duration left = last_progress + options_.patience - host_.now();
    if (left <= Duration::zero()) {
      stalled_ = true;
    } else if (bus_.wait_readable(left) && collect()) {
      last_progress = host_.now();
    }
  }
  now_ = std::max(now_, deadline);
  arrived_ = 0;
  sync_sent_ = false;
  sync_answers_missing_ = 0;
}

bool LockStep::complete() const noexcept {
  if (!ever_sent_) {
    return true;
  }
  return sync_sent_ ? sync_answers_missing_ == 0 : arrived_ >= expected_;
}

bool LockStep::collect() noexcept {
  std::array<ReceivedFrame, limits::kFramesPerCycle> frames;
  const std::size_t count = bus_.receive(frames, host_.now());
  bool due = false;
  for (const ReceivedFrame& frame : std::span(frames).first(count)) {
    due = take(frame) || due;
  }
  return due;
}

bool LockStep::take(const ReceivedFrame& received) noexcept {
  if (queued_ == kQueueFrames) {
    ++overflowed_;
  } else {
    queue_[(first_ + queued_) % kQueueFrames] = received;
    ++queued_;
  }
  ++arrived_;
  const auto* const id = std::find(options_.answer_ids.begin(), options_.answer_ids.end(), received.frame.id);
  if (!sync_sent_ || id == options_.answer_ids.end()) {
    return !sync_sent_;
  }
  const std::uint32_t bit = std::uint32_t{1} << (id - options_.answer_ids.begin());
  const bool missing = (sync_answers_missing_ & bit) != 0;
  sync_answers_missing_ &= ~bit;
  return missing;
}

}  // namespace ivo::hal
