// Numbers as an EDS writes them (CiA 306-1, 4.3): decimal, 0x for hexadecimal, a leading 0 for octal, and any of them
// with $NODEID added.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/eds/data_type.hpp"
#include "drivers/eds/eds_dictionary.hpp"

namespace ivo::drivers {

enum class EdsNumberStatus : std::uint8_t { kNumber, kNotANumber, kOutOfRange };

struct EdsNumber {
  EdsNumberStatus status = EdsNumberStatus::kNotANumber;
  EdsValue value;
};

/// `text` as a value of `type`, a BOOLEAN, an INTEGER, an UNSIGNED or a REAL. Hexadecimal and octal of a signed type
/// may also be its bits: 0xFF is -1 of INTEGER8. $NODEID is for unsigned types only, before or after the number.
[[nodiscard]] EdsNumber eds_number(std::string_view text, DataType type) noexcept;

[[nodiscard]] std::string_view trimmed(std::string_view text) noexcept;         ///< without blanks around it
[[nodiscard]] bool same_word(std::string_view a, std::string_view b) noexcept;  ///< ASCII, whatever the case
[[nodiscard]] bool starts_with_word(std::string_view text, std::string_view word) noexcept;

}  // namespace ivo::drivers
