// Emergency object (CiA 301, 7.2.7): sent once for each event; code 0 says that the errors are gone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/little_endian.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

struct Emergency {
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;       ///< 1001h
  std::array<std::uint8_t, 5> vendor{};  ///< what the manufacturer says about it
  friend bool operator==(const Emergency&, const Emergency&) = default;
};

/// None when `frame` is no emergency of a node or its length is wrong.
[[nodiscard]] constexpr std::optional<Emergency> parse_emergency(const hal::CanFrame& frame) noexcept {
  if ((frame.id & 0x780) != 0x080 || frame.id == cob_id::kSync || frame.size != 8) {
    return std::nullopt;
  }
  Emergency emergency{.code = load<std::uint16_t>(frame.data), .error_register = frame.data[2], .vendor = {}};
  std::copy(frame.data.begin() + 3, frame.data.end(), emergency.vendor.begin());
  return emergency;
}

[[nodiscard]] constexpr hal::CanFrame emergency_frame(std::uint8_t node_id, const Emergency& emergency) noexcept {
  hal::CanFrame frame{.id = cob_id::emcy(node_id), .size = 8, .data = {}};
  store(std::span(frame.data), emergency.code);
  frame.data[2] = emergency.error_register;
  std::copy(emergency.vendor.begin(), emergency.vendor.end(), frame.data.begin() + 3);
  return frame;
}

}  // namespace ivo::drivers
