// What a SocketCAN error frame says about the controller (linux/can/error.h).
#pragma once

#include <linux/can.h>

#include <optional>

#include "hal/api/can_bus.hpp"

namespace ivo::hal {

/// The state that `frame`, an error frame (CAN_ERR_FLAG set), tells; none when it speaks of something else, as of a
/// lost arbitration.
[[nodiscard]] std::optional<BusState> state_told_by(const can_frame& frame) noexcept;

}  // namespace ivo::hal
