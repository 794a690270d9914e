#include "hal/linux/error_frame.hpp"

#include <linux/can/error.h>

namespace ivo::hal {
namespace {

constexpr int kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
constexpr int kWarning = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;

void count_controller(int told, ErrorCounters& counters) noexcept {
  counters.receive_overflow += (told & CAN_ERR_CRTL_RX_OVERFLOW) != 0 ? 1 : 0;
  counters.transmit_overflow += (told & CAN_ERR_CRTL_TX_OVERFLOW) != 0 ? 1 : 0;
  counters.controller_passive += (told & kPassive) != 0 ? 1 : 0;
  counters.controller_warning += (told & kWarning) != 0 ? 1 : 0;
  counters.controller_active += (told & CAN_ERR_CRTL_ACTIVE) != 0 ? 1 : 0;
}

}  // namespace

std::optional<BusState> state_told_by(const can_frame& frame) noexcept {
  if ((frame.can_id & CAN_ERR_BUSOFF) != 0) {
    return BusState::kOff;
  }
  if ((frame.can_id & CAN_ERR_RESTARTED) != 0) {
    return BusState::kActive;
  }
  if ((frame.can_id & CAN_ERR_CRTL) == 0 || frame.can_dlc != CAN_ERR_DLC) {
    return std::nullopt;
  }
  const int controller = frame.data[1];
  if ((controller & kPassive) != 0) {
    return BusState::kPassive;
  }
  if ((controller & kWarning) != 0) {
    return BusState::kWarning;
  }
  if ((controller & CAN_ERR_CRTL_ACTIVE) != 0) {
    return BusState::kActive;
  }
  return std::nullopt;
}

void count_error(const can_frame& frame, ErrorCounters& counters) noexcept {
  const auto tells = [&frame](canid_t error_class) { return (frame.can_id & error_class) != 0; };
  counters.bus_off += tells(CAN_ERR_BUSOFF) ? 1 : 0;
  counters.restarted += tells(CAN_ERR_RESTARTED) ? 1 : 0;
  counters.transmit_timeout += tells(CAN_ERR_TX_TIMEOUT) ? 1 : 0;
  counters.no_acknowledgement += tells(CAN_ERR_ACK) ? 1 : 0;
  counters.bus_error += tells(CAN_ERR_BUSERROR) ? 1 : 0;
  if (frame.can_dlc != CAN_ERR_DLC) {
    ++counters.malformed;
    return;
  }
  if (tells(CAN_ERR_LOSTARB)) {
    ++counters.lost_arbitration;
    counters.last_arbitration_bit = frame.data[0];
  }
  if (tells(CAN_ERR_CRTL)) {
    count_controller(frame.data[1], counters);
  }
  if (tells(CAN_ERR_PROT)) {
    ++counters.protocol;
    counters.last_protocol_kind = frame.data[2];
    counters.last_protocol_place = frame.data[3];
  }
  if (tells(CAN_ERR_TRX)) {
    ++counters.transceiver;
    counters.last_transceiver_state = frame.data[4];
  }
  if (tells(CAN_ERR_CNT)) {
    counters.transmit_errors = frame.data[6];
    counters.receive_errors = frame.data[7];
  }
}

}  // namespace ivo::hal
