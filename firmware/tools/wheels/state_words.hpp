// Wheels, states and codes in words.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "config/robot.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/cia402/statusword.hpp"

namespace ivo::firmware {

[[nodiscard]] std::string_view name_of(Wheel wheel) noexcept;  ///< "front left"
[[nodiscard]] std::string_view key_of(Wheel wheel) noexcept;   ///< "front_left", as robot files have it
/// From a key, a name, or initials as "fl".
[[nodiscard]] std::optional<Wheel> wheel_called(std::string_view text) noexcept;
/// The wheel that has this node-id in `robot`.
[[nodiscard]] std::optional<Wheel> wheel_of(const Robot& robot, std::uint8_t node_id) noexcept;

[[nodiscard]] std::string name_of(drivers::NmtState state);
[[nodiscard]] std::string_view name_of(drivers::cia402::PowerState state) noexcept;

/// "7300h: sensor": an error code of an emergency or of 603Fh, and drivers::emergency_class of it.
[[nodiscard]] std::string error_code_text(std::uint16_t code);
/// "PV CSV*": modes of 6502h, a star at the one that the controller would choose.
[[nodiscard]] std::string modes_text(std::uint32_t supported_modes);
/// "7300h"
[[nodiscard]] std::string hexadecimal(std::uint32_t value, int digits);

}  // namespace ivo::firmware
