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
inline constexpr ObjectAddress kRevisionNumber{0x1018, 3};
inline constexpr ObjectAddress kSerialNumber{0x1018, 4};
inline constexpr ObjectAddress kErrorBehaviour{0x1029, 1};  // of a communication error
inline constexpr ObjectAddress kRpdo1CobId{0x1400, 1};
inline constexpr ObjectAddress kRpdo1Type{0x1400, 2};
inline constexpr ObjectAddress kRpdo1Count{0x1600, 0};
inline constexpr ObjectAddress kTpdo1CobId{0x1800, 1};
inline constexpr ObjectAddress kTpdo1Type{0x1800, 2};
inline constexpr ObjectAddress kTpdo1Count{0x1A00, 0};

// PDO `number`, from 1: its COB-ID, transmission type, deadline (RPDO only, milliseconds) and count of mapped objects.
[[nodiscard]] constexpr ObjectAddress pdo_object(std::uint16_t first, std::uint8_t number, std::uint8_t sub) noexcept {
  return {static_cast<std::uint16_t>(first + number - 1), sub};
}
[[nodiscard]] constexpr ObjectAddress rpdo_cob_id(std::uint8_t number) noexcept {
  return pdo_object(0x1400, number, 1);
}
[[nodiscard]] constexpr ObjectAddress rpdo_type(std::uint8_t number) noexcept { return pdo_object(0x1400, number, 2); }
[[nodiscard]] constexpr ObjectAddress rpdo_deadline(std::uint8_t number) noexcept {
  return pdo_object(0x1400, number, 5);
}
[[nodiscard]] constexpr ObjectAddress rpdo_count(std::uint8_t number) noexcept { return pdo_object(0x1600, number, 0); }
[[nodiscard]] constexpr ObjectAddress tpdo_cob_id(std::uint8_t number) noexcept {
  return pdo_object(0x1800, number, 1);
}
[[nodiscard]] constexpr ObjectAddress tpdo_type(std::uint8_t number) noexcept { return pdo_object(0x1800, number, 2); }
[[nodiscard]] constexpr ObjectAddress tpdo_count(std::uint8_t number) noexcept { return pdo_object(0x1A00, number, 0); }

// Dummy entries: mapped into an RPDO, they pass over data that is for another node (CiA 301, 7.4.7.1).
inline constexpr ObjectAddress kDummyInteger32{0x0004, 0};
inline constexpr ObjectAddress kDummyUnsigned32{0x0007, 0};

/// Entry `n`, from 1, of the mapping whose count is `count`.
[[nodiscard]] constexpr ObjectAddress mapping_entry(ObjectAddress count, std::uint8_t n) noexcept {
  return {count.index, n};
}

/// Value of a mapping entry: which object and how many bits of it.
[[nodiscard]] constexpr std::uint32_t mapped(ObjectAddress object, std::uint8_t bits) noexcept {
  return std::uint32_t{object.index} << 16 | std::uint32_t{object.sub} << 8 | bits;
}

}  // namespace ivo::drivers::object
