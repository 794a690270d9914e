#include "hal/linux/error_frame.hpp"

#include <linux/can/error.h>

namespace ivo::hal {

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
  if ((controller & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) {
    return BusState::kPassive;
  }
  if ((controller & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0) {
    return BusState::kWarning;
  }
  if ((controller & CAN_ERR_CRTL_ACTIVE) != 0) {
    return BusState::kActive;
  }
  return std::nullopt;
}

}  // namespace ivo::hal
