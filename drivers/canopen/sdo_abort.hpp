// SDO abort codes and their names (CiA 301, table 22).
#pragma once

#include <cstdint>
#include <string_view>

namespace ivo::drivers {

enum class SdoAbort : std::uint32_t {
  kToggle = 0x05030000,
  kTimeout = 0x05040000,
  kCommandSpecifier = 0x05040001,
  kBlockSize = 0x05040002,
  kSequenceNumber = 0x05040003,
  kCrc = 0x05040004,
  kMemory = 0x05040005,
  kAccess = 0x06010000,
  kWriteOnly = 0x06010001,
  kReadOnly = 0x06010002,
  kNoObject = 0x06020000,
  kNotMappable = 0x06040041,
  kPdoLength = 0x06040042,
  kParameterIncompatible = 0x06040043,
  kDeviceIncompatible = 0x06040047,
  kHardware = 0x06060000,
  kLength = 0x06070010,
  kLengthTooHigh = 0x06070012,
  kLengthTooLow = 0x06070013,
  kNoSubIndex = 0x06090011,
  kValueRange = 0x06090030,
  kValueTooHigh = 0x06090031,
  kValueTooLow = 0x06090032,
  kMaximumBelowMinimum = 0x06090036,
  kResource = 0x060A0023,
  kGeneral = 0x08000000,
  kNotStorable = 0x08000020,
  kLocalControl = 0x08000021,
  kDeviceState = 0x08000022,
  kNoDictionary = 0x08000023,
  kNoData = 0x08000024,
};

/// The standard's words; "unknown abort code" for any other.
[[nodiscard]] std::string_view name_of(SdoAbort code) noexcept;

}  // namespace ivo::drivers
