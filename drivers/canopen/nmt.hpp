// Network management: orders of the master and states that nodes report (CiA 301, 7.2.8 and 7.3.2).
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/canopen/cob_id.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

enum class NmtCommand : std::uint8_t {
  kStart = 0x01,
  kStop = 0x02,
  kEnterPreOperational = 0x80,
  kResetNode = 0x81,
  kResetCommunication = 0x82,
};

/// As a boot-up or heartbeat frame carries it.
enum class NmtState : std::uint8_t { kBootUp = 0x00, kStopped = 0x04, kOperational = 0x05, kPreOperational = 0x7F };

struct NmtOrder {
  NmtCommand command = NmtCommand::kStart;
  std::uint8_t node_id = 0;  ///< 0: all nodes
};

[[nodiscard]] constexpr hal::CanFrame nmt_frame(NmtOrder order) noexcept {
  return {.id = cob_id::kNmt, .size = 2, .data = {static_cast<std::uint8_t>(order.command), order.node_id}};
}

/// None when `frame` is not an NMT order of the right length.
[[nodiscard]] constexpr std::optional<NmtOrder> parse_nmt(const hal::CanFrame& frame) noexcept {
  if (frame.id != cob_id::kNmt || frame.size != 2) {
    return std::nullopt;
  }
  return NmtOrder{static_cast<NmtCommand>(frame.data[0]), frame.data[1]};
}

[[nodiscard]] constexpr hal::CanFrame heartbeat_frame(std::uint8_t node_id, NmtState state) noexcept {
  return {.id = cob_id::heartbeat(node_id), .size = 1, .data = {static_cast<std::uint8_t>(state)}};
}

/// The state in a boot-up or heartbeat frame of any node; none when the length is wrong. Some nodes set bit 7, the
/// toggle of node guarding: it says nothing.
[[nodiscard]] constexpr std::optional<NmtState> parse_heartbeat(const hal::CanFrame& frame) noexcept {
  if ((frame.id & 0x780) != 0x700 || frame.size != 1) {
    return std::nullopt;
  }
  return static_cast<NmtState>(frame.data[0] & 0x7F);
}

}  // namespace ivo::drivers
