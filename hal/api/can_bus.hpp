// A CAN interface as the loop uses it: nothing here waits, allocates or throws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/api/can_frame.hpp"

namespace ivo::hal {

enum class BusState : std::uint8_t { kActive, kWarning, kPassive, kOff, kDown, kRemoved };

struct BusCounters {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t send_dropped = 0;     ///< the queue was full or the interface down
  std::uint64_t receive_dropped = 0;  ///< lost before we read it
};

class CanBus {
 public:
  virtual ~CanBus() = default;

  /// Copies frames received since the last call, oldest first, as many as fit; returns how many.
  virtual std::size_t receive(std::span<CanFrame> frames) noexcept = 0;

  /// Hands frames to the interface in order; returns how many it took. The rest is dropped and counted, never kept for
  /// later: an old velocity must not move a wheel.
  virtual std::size_t send(std::span<const CanFrame> frames) noexcept = 0;

  [[nodiscard]] virtual BusState state() const noexcept = 0;
  [[nodiscard]] virtual BusCounters counters() const noexcept = 0;
};

}  // namespace ivo::hal
