#include "hal/sim/virtual_bus.hpp"

#include <algorithm>

#include "config/base/contract.hpp"

namespace ivo::hal {

VirtualBus::VirtualBus() noexcept {
  for (Port& port : ports_) {
    port.bus_ = this;
  }
}

CanBus& VirtualBus::port(std::size_t index) noexcept {
  IVO_CONTRACT(index < kPorts);
  return ports_[index];
}

void VirtualBus::set_state(std::size_t index, BusState state) noexcept {
  IVO_CONTRACT(index < kPorts);
  Port& port = ports_[index];
  port.state_ = state;
  if (!port.connected()) {
    port.queued_ = 0;
  }
}

std::size_t VirtualBus::Port::receive(std::span<ReceivedFrame> frames, Instant now) noexcept {
  const std::size_t count = std::min(frames.size(), queued_);
  for (std::size_t i = 0; i < count; ++i) {
    frames[i] = queue_[(first_ + i) % kQueueFrames];
    frames[i].at = std::min(frames[i].at, now);
  }
  first_ = (first_ + count) % kQueueFrames;
  queued_ -= count;
  counters_.received += count;
  return count;
}

std::size_t VirtualBus::Port::send(std::span<const CanFrame> frames, Instant now) noexcept {
  if (!connected()) {
    counters_.send_dropped += frames.size();
    return 0;
  }
  for (const CanFrame& frame : frames) {
    IVO_CONTRACT(frame.id <= 0x7FF && frame.size <= 8);
    for (Port& other : bus_->ports_) {
      if (&other != this && other.connected()) {
        other.put(frame, now);
      }
    }
  }
  counters_.sent += frames.size();
  counters_.confirmed += frames.size();
  return frames.size();
}

void VirtualBus::Port::put(const CanFrame& frame, Instant now) noexcept {
  if (queued_ == kQueueFrames) {
    ++counters_.receive_dropped;
    return;
  }
  queue_[(first_ + queued_) % kQueueFrames] = {.frame = frame, .at = now};
  ++queued_;
}

}  // namespace ivo::hal
