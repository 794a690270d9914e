// Emergencies in words. Outside of the loop only: it allocates.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "drivers/canopen/emcy_history.hpp"

namespace ivo::drivers {

/// What an error code is about (CiA 301, table 26; CiA 402-2, 6.3): the most exact class that is known, as "heartbeat
/// or node guarding lost" for 8130h, "temperature" for 42FFh; "unknown error" for what no class holds.
[[nodiscard]] std::string_view emergency_class(std::uint16_t code) noexcept;

/// One line, as: emergency 8130h, heartbeat or node guarding lost (error register 11h: generic, communication; vendor
/// 01 00 00 00 00), 3 times.
[[nodiscard]] std::string describe(const EmcyEntry& entry);

}  // namespace ivo::drivers
