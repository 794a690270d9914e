// Every frame that passes, into the trace: between the guarded bus and the real one.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/record/tracer.hpp"
#include "hal/api/can_bus.hpp"

namespace ivo::firmware {

/// Thread: the bus's, which is the tracer's.
class TracedBus final : public hal::CanBus {
 public:
  /// Both outlive this.
  TracedBus(hal::CanBus& inner, Tracer& tracer) noexcept : inner_(inner), tracer_(tracer) {}

  std::size_t receive(std::span<hal::ReceivedFrame> frames, Instant now) noexcept override {
    const std::size_t count = inner_.receive(frames, now);
    tracer_.frames_in(frames.first(count), now);
    return count;
  }

  std::size_t send(std::span<const hal::CanFrame> frames, Instant now) noexcept override {
    const std::size_t count = inner_.send(frames, now);
    tracer_.frames_out(inner_.handed_over());
    return count;
  }

  [[nodiscard]] std::span<const hal::CanFrame> handed_over() const noexcept override { return inner_.handed_over(); }
  [[nodiscard]] hal::BusState state() const noexcept override { return inner_.state(); }
  [[nodiscard]] hal::BusCounters counters() const noexcept override { return inner_.counters(); }

 private:
  hal::CanBus& inner_;
  Tracer& tracer_;
};

}  // namespace ivo::firmware
