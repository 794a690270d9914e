// A CAN bus inside one process: what one port sends, every other port receives, in order and at once.
#pragma once

#include <array>
#include <cstddef>

#include "hal/api/can_bus.hpp"

namespace ivo::hal {

/// Single-threaded, deterministic, no heap. A port's receive queue is bounded: what overflows is lost and counted at
/// the receiver (receive_dropped), as with a kernel's socket. About 50 KB.
class VirtualBus {
 public:
  static constexpr std::size_t kPorts = 8;
  static constexpr std::size_t kQueueFrames = 512;

  VirtualBus() noexcept;
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;

  /// Port `index`, below kPorts; lives as long as the bus.
  [[nodiscard]] CanBus& port(std::size_t index) noexcept;

  /// What port `index` reports from now on. A port whose bus is lost sends and receives nothing; its queue is purged.
  void set_state(std::size_t index, BusState state) noexcept;

 private:
  class Port final : public CanBus {
   public:
    std::size_t receive(std::span<ReceivedFrame> frames, Instant now) noexcept override;
    std::size_t send(std::span<const CanFrame> frames, Instant now) noexcept override;
    [[nodiscard]] BusState state() const noexcept override { return state_; }
    [[nodiscard]] BusCounters counters() const noexcept override { return counters_; }

   private:
    friend class VirtualBus;
    [[nodiscard]] bool connected() const noexcept { return !lost(state_); }
    void put(const CanFrame& frame, Instant now) noexcept;

    VirtualBus* bus_ = nullptr;
    BusState state_ = BusState::kActive;
    BusCounters counters_;
    std::array<ReceivedFrame, kQueueFrames> queue_{};
    std::size_t first_ = 0;
    std::size_t queued_ = 0;
  };

  std::array<Port, kPorts> ports_;
};

}  // namespace ivo::hal
