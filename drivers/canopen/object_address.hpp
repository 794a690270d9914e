// Where an object lies in an object dictionary.
#pragma once

#include <cstdint>

namespace ivo::drivers {

struct ObjectAddress {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  friend bool operator==(const ObjectAddress&, const ObjectAddress&) = default;
};

}  // namespace ivo::drivers
