// Classical CAN data frames with an 11-bit identifier. Remote, extended, FD and error frames never get this far.
#pragma once

#include <array>
#include <cstdint>

#include "config/base/time.hpp"

namespace ivo::hal {

struct CanFrame {
  std::uint16_t id = 0;   ///< 0 to 7FFh
  std::uint8_t size = 0;  ///< bytes of data, 0 to 8
  std::array<std::uint8_t, 8> data{};
  friend bool operator==(const CanFrame&, const CanFrame&) = default;
};

enum class FrameOrigin : std::uint8_t {
  kBus,       ///< another node
  kThisHost,  ///< another program on this computer
};

struct ReceivedFrame {
  CanFrame frame;
  Instant at{};  ///< arrival, on the clock of receive()'s `now`: never after it, never before the receive() before
  FrameOrigin origin = FrameOrigin::kBus;
};

}  // namespace ivo::hal
