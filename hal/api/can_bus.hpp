// A CAN interface as the loop uses it: nothing here waits, allocates or throws.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "config/base/time.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::hal {

/// From bad to worse; from kUnconfirmed on the bus is lost: what we send reaches nobody.
enum class BusState : std::uint8_t {
  kActive,
  kWarning,      ///< error counters above 96
  kPassive,      ///< above 127
  kUnconfirmed,  ///< nothing that was handed over has left for rates::kTransmitTimeout: alone, or wrong bit rate
  kOff,          ///< bus-off: above 255
  kDown,         ///< the interface is not up
  kRemoved,      ///< it is not there
};
inline constexpr int kBusStates = 7;

/// In words for a person, as part of a sentence.
[[nodiscard]] constexpr std::string_view name_of(BusState state) noexcept {
  constexpr std::array<std::string_view, kBusStates> kNames{
      "active",
      "error warning",
      "error passive",
      "nothing that is sent leaves: no other node, another bit rate, or no cable",
      "bus-off",
      "the interface is down",
      "the interface was removed"};
  return kNames[static_cast<std::size_t>(state)];
}
[[nodiscard]] constexpr bool lost(BusState state) noexcept { return state >= BusState::kUnconfirmed; }

struct BusCounters {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;             ///< handed over to the interface
  std::uint64_t confirmed = 0;        ///< of those, seen to leave
  std::uint64_t send_dropped = 0;     ///< never handed over: the queue was full or the interface down until
                                      ///< rates::kTransmitAge had passed, or there was no place to keep them
  std::uint64_t send_replaced = 0;    ///< never handed over: a newer frame of the same COB-ID came first
  std::uint64_t send_refused = 0;     ///< never handed over: a bus that judges what passes it does not let it
  std::uint64_t receive_dropped = 0;  ///< lost before we read it
};

class CanBus {
 public:
  virtual ~CanBus() = default;

  /// Copies frames received since the last call, oldest first, as many as fit; returns how many. Own frames are not
  /// among them.
  virtual std::size_t receive(std::span<ReceivedFrame> frames, Instant now) noexcept = 0;

  /// Hands frames to the interface in order; returns how many of them it took now. Of the rest the newest of each
  /// COB-ID (of NMT: of each node) goes out with a later call, unless it is older than rates::kTransmitAge by then: an
  /// old velocity must not move a wheel. A frame also waits while one of its COB-ID is on its way. So to be called each
  /// cycle, with nothing to say too.
  virtual std::size_t send(std::span<const CanFrame> frames, Instant now) noexcept = 0;

  /// The frames that the last send() handed over, in the order in which they went: those that waited since an earlier
  /// call among them. None when the bus was lost by then. Valid until the next call of this bus.
  [[nodiscard]] virtual std::span<const CanFrame> handed_over() const noexcept = 0;

  [[nodiscard]] virtual BusState state() const noexcept = 0;
  [[nodiscard]] virtual BusCounters counters() const noexcept = 0;
};

}  // namespace ivo::hal
