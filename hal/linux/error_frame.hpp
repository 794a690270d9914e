// What a SocketCAN error frame says about controller and bus (linux/can/error.h).
#pragma once

#include <linux/can.h>

#include <cstdint>
#include <optional>

#include "hal/api/can_bus.hpp"

namespace ivo::hal {

/// How often each class of error was told since the interface was opened, and the newest details.
struct ErrorCounters {
  std::uint64_t bus_off = 0;
  std::uint64_t restarted = 0;
  std::uint64_t controller_warning = 0;
  std::uint64_t controller_passive = 0;
  std::uint64_t controller_active = 0;   ///< came back from warning or passive
  std::uint64_t receive_overflow = 0;    ///< the controller lost at least one frame
  std::uint64_t transmit_overflow = 0;   ///< the same in sending
  std::uint64_t transmit_timeout = 0;    ///< by the driver
  std::uint64_t no_acknowledgement = 0;  ///< nobody there, or nobody at this bit rate
  std::uint64_t lost_arbitration = 0;
  std::uint64_t protocol = 0;  ///< bit, stuff, form, CRC: a disturbed line, or two bit rates
  std::uint64_t transceiver = 0;
  std::uint64_t bus_error = 0;  ///< error flags seen on the bus; with berr-reporting they come in floods
  std::uint64_t malformed = 0;  ///< error frames of a length that says nothing

  std::uint8_t last_protocol_kind = 0;      ///< CAN_ERR_PROT_...: a bit for each kind
  std::uint8_t last_protocol_place = 0;     ///< CAN_ERR_PROT_LOC_...: where in the frame
  std::uint8_t last_arbitration_bit = 0;    ///< the bit that was lost; 0 when unknown
  std::uint8_t last_transceiver_state = 0;  ///< CAN_ERR_TRX_...
  std::uint16_t transmit_errors = 0;        ///< the controller's TEC, when last told (class 200h, or by netlink)
  std::uint16_t receive_errors = 0;         ///< REC
};

/// The controller's state that `frame`, an error frame (CAN_ERR_FLAG set), tells; none when it speaks of something
/// else, as of a lost arbitration. Bus-off outweighs what else the frame says, being restarted all but that.
[[nodiscard]] std::optional<BusState> state_told_by(const can_frame& frame) noexcept;

/// Adds what `frame` tells to `counters`.
void count_error(const can_frame& frame, ErrorCounters& counters) noexcept;

}  // namespace ivo::hal
