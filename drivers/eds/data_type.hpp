// The basic data types of an object dictionary, by their index in it (CiA 301, 7.4.7, table 44).
#pragma once

#include <cstdint>

namespace ivo::drivers {

enum class DataType : std::uint16_t {
  kNone = 0x00,
  kBoolean = 0x01,
  kInteger8 = 0x02,
  kInteger16 = 0x03,
  kInteger32 = 0x04,
  kUnsigned8 = 0x05,
  kUnsigned16 = 0x06,
  kUnsigned32 = 0x07,
  kReal32 = 0x08,
  kVisibleString = 0x09,
  kOctetString = 0x0A,
  kUnicodeString = 0x0B,
  kTimeOfDay = 0x0C,
  kTimeDifference = 0x0D,
  kDomain = 0x0F,
  kInteger24 = 0x10,
  kReal64 = 0x11,
  kInteger40 = 0x12,
  kInteger48 = 0x13,
  kInteger56 = 0x14,
  kInteger64 = 0x15,
  kUnsigned24 = 0x16,
  kUnsigned40 = 0x18,
  kUnsigned48 = 0x19,
  kUnsigned56 = 0x1A,
  kUnsigned64 = 0x1B,
};

/// Bytes of a value on the bus; 0 where the type has no fixed size, and for types that CiA 301 does not define.
[[nodiscard]] std::uint8_t bytes_of(DataType type) noexcept;

[[nodiscard]] bool is_signed(DataType type) noexcept;    ///< two's complement
[[nodiscard]] bool is_unsigned(DataType type) noexcept;  ///< BOOLEAN too
[[nodiscard]] bool is_real(DataType type) noexcept;      ///< IEEE 754
[[nodiscard]] bool is_text(DataType type) noexcept;      ///< a string of any kind

/// Least and most of an integer type, in 64 bits.
[[nodiscard]] std::int64_t least_of(DataType type) noexcept;
[[nodiscard]] std::uint64_t most_of(DataType type) noexcept;

}  // namespace ivo::drivers
