#include "hal/linux/lock_step.hpp"

#include <algorithm>

#include "config/limits.hpp"
#include "config/rates.hpp"

namespace ivo::hal {
namespace {

constexpr Duration kLookUp = std::chrono::milliseconds(100);  // from waiting, whether somebody is in a hurry

}  // namespace

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

std::size_t LockStep::send(std::span<const CanFrame> frames, Instant now) noexcept {
  const std::uint64_t before = bus_.counters().sent;
  const std::size_t count = bus_.send(frames, now);
  ever_sent_ = ever_sent_ || bus_.counters().sent > before;
  if (bus_.just_sent(options_.sync_id)) {
    sync_sent_ = true;
    sync_answers_missing_ = (std::uint32_t{1} << options_.answer_ids.size()) - 1;
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
  if (bus_gone()) {
    bus_.look_at_interface();
  } else {
    await_answers();
    await_departure();
  }
  now_ = std::max(now_, deadline);
  arrived_ = 0;
  sync_sent_ = false;
  sync_answers_missing_ = 0;
}

void LockStep::await_answers() noexcept {
  // In vain, since something came last. A machine that stood still has not waited: each look counts for two at most.
  Duration waited{};
  while (!stalled_ && !complete() && !bus_gone()) {
    bool came = false;
    const bool hurry = hurry_.load(std::memory_order_relaxed);
    const Duration patience = hurry ? std::min(options_.patience, kHurry) : options_.patience;
    const Duration left = patience - waited;
    if (left <= Duration::zero()) {
      stalled_ = true;
      return;
    }
    const Instant before = host_.now();
    switch (bus_.wait(std::min(left, kLookUp))) {
      case SocketCanBus::Woken::kByFrame:
        came = collect();
        break;
      case SocketCanBus::Woken::kBySignal:
        interrupt();
        break;
      case SocketCanBus::Woken::kByTime:
        break;
    }
    waited = came ? Duration::zero() : waited + std::min<Duration>(host_.now() - before, 2 * kLookUp);
  }
}

// Our time must not outrun what we sent: how long a kernel takes to show us a frame again is not for the loop to judge.
void LockStep::await_departure() noexcept {
  const Instant limit = host_.now() + rates::kTransmitTimeout;
  while (bus_.in_flight() > 0 && !bus_gone() && host_.now() < limit) {
    (void)bus_.wait(limit - host_.now());
    collect();
  }
}

bool LockStep::bus_gone() const noexcept { return lost(bus_.state()) && bus_.state() != BusState::kUnconfirmed; }

bool LockStep::complete() const noexcept {
  if (!ever_sent_) {
    return true;
  }
  return sync_sent_ ? sync_answers_missing_ == 0 : arrived_ >= expected_;
}

bool LockStep::collect() noexcept {
  std::array<ReceivedFrame, limits::kFramesPerCycle> frames;
  const std::size_t count = bus_.receive(frames, now_);
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
