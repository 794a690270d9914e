// A copy of every frame that passes, for the record: between the guarded bus and the real one, so it holds what was
// really handed over, and nothing that was refused.
#pragma once

#include <cstddef>
#include <span>

#include "config/base/spsc_ring.hpp"
#include "config/base/time.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::firmware {

struct RecordedFrame {
  Instant at{};  ///< of a received frame its arrival, of a sent one the cycle that handed it over
  hal::CanFrame frame;
};

/// 1.5 MB: 7 s of a bus at 1 Mbit/s that is full, 14 s of our own traffic. What does not fit is lost and counted.
inline constexpr std::size_t kRecordedFrames = 65'536;
using FrameRing = SpscRing<RecordedFrame, kRecordedFrames>;

/// Times in the ring never go back. Thread: the bus's; another one reads the ring. Cost: 24 bytes copied a frame.
class RecordingBus final : public hal::CanBus {
 public:
  /// Both outlive this.
  RecordingBus(hal::CanBus& inner, FrameRing& ring) noexcept : inner_(inner), ring_(ring) {}

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override {
    const std::size_t count = inner_.receive(frames, now);
    for (const hal::ReceivedFrame& received : frames.first(count)) {
      keep(received.frame, received.at);
    }
    return count;
  }

  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override {
    const std::size_t count = inner_.send(frames, now);
    for (const hal::CanFrame& sent : inner_.handed_over()) {  // not those of `frames`: some wait, some have waited
      keep(sent, now);
    }
    return count;
  }

  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return inner_.counters(); }

 private:
  void keep(const hal::CanFrame& frame, Instant at) noexcept {
    (void)ring_.push({at, frame});  // a loss is counted by the ring
  }

  hal::CanBus& inner_;
  FrameRing& ring_;
};

}  // namespace ivo::firmware
