// One classical CAN data frame with an 11-bit identifier. Remote, extended, FD and error frames never get this far.
#pragma once

#include <array>
#include <cstdint>

namespace ivo::hal {

struct CanFrame {
  std::uint16_t id = 0;   ///< 0 to 7FFh
  std::uint8_t size = 0;  ///< bytes of data, 0 to 8
  std::array<std::uint8_t, 8> data{};
  friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

}  // namespace ivo::hal
