// The objects of the communication profile (CiA 301, 7.5) that the product reads or writes.
#pragma once

#include "drivers/canopen/object_address.hpp"

namespace ivo::drivers::object {

inline constexpr ObjectAddress kDeviceType{0x1000, 0};
inline constexpr ObjectAddress kErrorRegister{0x1001, 0};
inline constexpr ObjectAddress kSyncCobId{0x1005, 0};
inline constexpr ObjectAddress kCyclePeriod{0x1006, 0};  // microseconds
inline constexpr ObjectAddress kConsumerHeartbeat{0x1016, 1};
inline constexpr ObjectAddress kProducerHeartbeat{0x1017, 0};  // milliseconds
inline constexpr ObjectAddress kVendorId{0x1018, 1};
inline constexpr ObjectAddress kProductCode{0x1018, 2};
inline constexpr ObjectAddress kRpdo1CobId{0x1400, 1};
inline constexpr ObjectAddress kRpdo1Type{0x1400, 2};
inline constexpr ObjectAddress kRpdo1Count{0x1600, 0};
inline constexpr ObjectAddress kTpdo1CobId{0x1800, 1};
inline constexpr ObjectAddress kTpdo1Type{0x1800, 2};
inline constexpr ObjectAddress kTpdo1Count{0x1A00, 0};

/// Entry `n`, from 1, of the mapping whose count is `count`.
[[nodiscard]] constexpr ObjectAddress mapping_entry(ObjectAddress count, std::uint8_t n) noexcept {
  return {count.index, n};
}

/// Value of a mapping entry: which object and how many bits of it.
[[nodiscard]] constexpr std::uint32_t mapped(ObjectAddress object, std::uint8_t bits) noexcept {
  return std::uint32_t{object.index} << 16 | std::uint32_t{object.sub} << 8 | bits;
}

}  // namespace ivo::drivers::object
