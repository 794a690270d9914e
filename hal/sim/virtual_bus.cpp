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
    port.table_.forget();
  }
}

void VirtualBus::set_room(std::size_t index, std::size_t frames) noexcept {
  IVO_CONTRACT(index < kPorts);
  ports_[index].room_ = frames;
}

void VirtualBus::lose(std::uint16_t id, std::uint64_t count) noexcept {
  lost_id_ = id;
  to_lose_ = count;
}

void VirtualBus::inject(const CanFrame& frame, Instant now, FrameOrigin origin) noexcept {
  IVO_CONTRACT(frame.id <= 0x7FF && frame.size <= 8);
  deliver({.frame = frame, .at = now, .origin = origin}, nullptr);
}

void VirtualBus::deliver(const ReceivedFrame& received, const Port* sender) noexcept {
  if (to_lose_ > 0 && received.frame.id == lost_id_) {
    --to_lose_;
    return;
  }
  ReceivedFrame later = received;
  later.at += latency_;
  for (Port& port : ports_) {
    if (&port != sender && port.connected()) {
      port.put(later);
    }
  }
}

std::size_t VirtualBus::Port::receive(std::span<ReceivedFrame> frames, Instant now) noexcept {
  std::size_t count = 0;
  while (count < frames.size() && queued_ > 0) {
    const ReceivedFrame& oldest = queue_[first_];
    if (bus_->latency_ > Duration::zero() && oldest.at > now) {
      break;
    }
    frames[count] = oldest;
    frames[count].at = std::min(oldest.at, now);
    ++count;
    first_ = (first_ + 1) % kQueueFrames;
    --queued_;
  }
  received_ += count;
  return count;
}

std::size_t VirtualBus::Port::send(std::span<const CanFrame> frames, Instant now) noexcept {
  if (!connected()) {
    refused_ += frames.size();
    return 0;
  }
  const std::span<const CanFrame> batch = table_.offer(frames, now);
  const std::size_t taken = std::min(batch.size(), room_);
  for (const CanFrame& frame : batch.first(taken)) {
    bus_->deliver({.frame = frame, .at = now}, this);
  }
  return table_.handed_over(taken, now);
}

BusCounters VirtualBus::Port::counters() const noexcept {
  const TransmitTable::Counters& sent = table_.counters();
  return {.received = received_,
          .sent = sent.handed_over,
          .confirmed = sent.confirmed,
          .send_dropped = sent.dropped + refused_,
          .send_replaced = sent.replaced,
          .receive_dropped = receive_dropped_};
}

void VirtualBus::Port::put(const ReceivedFrame& frame) noexcept {
  if (queued_ == kQueueFrames) {
    ++receive_dropped_;
    return;
  }
  queue_[(first_ + queued_) % kQueueFrames] = frame;
  ++queued_;
}

}  // namespace ivo::hal
