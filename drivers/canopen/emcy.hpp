// Emergency object (CiA 301, 7.2.7): sent once for each event; code 0 says that the errors are gone.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/little_endian.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

struct Emergency {
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;  ///< 1001h
};

/// None when `frame` is no emergency of a node or its length is wrong.
[[nodiscard]] constexpr std::optional<Emergency> parse_emergency(const hal::CanFrame& frame) noexcept {
  if ((frame.id & 0x780) != 0x080 || frame.id == cob_id::kSync || frame.size != 8) {
    return std::nullopt;
  }
  return Emergency{load<std::uint16_t>(frame.data), frame.data[2]};
}

[[nodiscard]] constexpr hal::CanFrame emergency_frame(std::uint8_t node_id, Emergency emergency) noexcept {
  hal::CanFrame frame{.id = cob_id::emcy(node_id), .size = 8, .data = {}};
  store(std::span(frame.data), emergency.code);
  frame.data[2] = emergency.error_register;
  return frame;
}

}  // namespace ivo::drivers
