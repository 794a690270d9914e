// A CAN bus inside one process: what one port sends, every other port receives, in order and at once, unless a test
// asks for less.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/api/can_bus.hpp"
#include "hal/api/transmit_table.hpp"

namespace ivo::hal {

/// Single-threaded, deterministic, no heap. A port's receive queue is bounded: what overflows is lost and counted at
/// the receiver (receive_dropped), as with a kernel's socket. About 260 KB.
class VirtualBus {
 public:
  static constexpr std::size_t kPorts = 8;
  static constexpr std::size_t kQueueFrames = 512;

  VirtualBus() noexcept;
  VirtualBus(const VirtualBus&) = delete;
  VirtualBus& operator=(const VirtualBus&) = delete;

  /// Port `index`, below kPorts; lives as long as the bus.
  [[nodiscard]] CanBus& port(std::size_t index) noexcept;

  // What can go wrong, from now on:

  /// What port `index` reports. A port whose bus is lost sends and receives nothing; its queues are purged.
  void set_state(std::size_t index, BusState state) noexcept;
  /// How many frames port `index` takes in one send, as an interface whose queue is almost full.
  void set_room(std::size_t index, std::size_t frames) noexcept;
  /// The next `count` frames with this COB-ID reach nobody, though they count as sent. One COB-ID at a time.
  void lose(std::uint16_t id, std::uint64_t count) noexcept;
  /// Frames arrive so long after they were sent; order is kept.
  void set_latency(Duration latency) noexcept { latency_ = latency; }
  /// A frame from nowhere, for every port.
  void inject(const CanFrame& frame, Instant now, FrameOrigin origin = FrameOrigin::kBus) noexcept;

 private:
  class Port final : public CanBus {
   public:
    std::size_t receive(std::span<ReceivedFrame> frames, Instant now) noexcept override;
    std::size_t send(std::span<const CanFrame> frames, Instant now) noexcept override;
    [[nodiscard]] std::span<const CanFrame> handed_over() const noexcept override { return table_.just_handed_over(); }
    [[nodiscard]] BusState state() const noexcept override { return state_; }
    [[nodiscard]] BusCounters counters() const noexcept override;

   private:
    friend class VirtualBus;
    [[nodiscard]] bool connected() const noexcept { return !lost(state_); }
    void put(const ReceivedFrame& frame) noexcept;

    VirtualBus* bus_ = nullptr;
    BusState state_ = BusState::kActive;
    TransmitTable table_;
    std::size_t room_ = TransmitTable::kBatch;
    std::uint64_t received_ = 0;
    std::uint64_t receive_dropped_ = 0;
    std::uint64_t refused_ = 0;
    std::array<ReceivedFrame, kQueueFrames> queue_{};
    std::size_t first_ = 0;
    std::size_t queued_ = 0;
  };

  void deliver(const ReceivedFrame& frame, const Port* sender) noexcept;

  std::array<Port, kPorts> ports_;
  Duration latency_{};
  std::uint16_t lost_id_ = 0;
  std::uint64_t to_lose_ = 0;
};

}  // namespace ivo::hal
