// COB-IDs of the predefined connection set (CiA 301, 7.3.3). PDOs are named from the device's view: a drive sends its
// TPDO.
#pragma once

#include <cstdint>

namespace ivo::drivers::cob_id {

inline constexpr std::uint16_t kNmt = 0x000;
inline constexpr std::uint16_t kSync = 0x080;

[[nodiscard]] constexpr std::uint16_t of(std::uint16_t function, std::uint8_t node_id) noexcept {
  return static_cast<std::uint16_t>(function + node_id);
}
[[nodiscard]] constexpr std::uint16_t emcy(std::uint8_t node_id) noexcept { return of(0x080, node_id); }
/// `number` from 1 to kPdos.
inline constexpr std::uint8_t kPdos = 4;
[[nodiscard]] constexpr std::uint16_t tpdo(std::uint8_t number, std::uint8_t node_id) noexcept {
  return of(static_cast<std::uint16_t>(0x080 + 0x100 * number), node_id);
}
[[nodiscard]] constexpr std::uint16_t rpdo(std::uint8_t number, std::uint8_t node_id) noexcept {
  return of(static_cast<std::uint16_t>(0x100 + 0x100 * number), node_id);
}
[[nodiscard]] constexpr std::uint16_t tpdo1(std::uint8_t node_id) noexcept { return tpdo(1, node_id); }
[[nodiscard]] constexpr std::uint16_t rpdo1(std::uint8_t node_id) noexcept { return rpdo(1, node_id); }
[[nodiscard]] constexpr std::uint16_t sdo_answer(std::uint8_t node_id) noexcept { return of(0x580, node_id); }
[[nodiscard]] constexpr std::uint16_t sdo_request(std::uint8_t node_id) noexcept { return of(0x600, node_id); }
[[nodiscard]] constexpr std::uint16_t heartbeat(std::uint8_t node_id) noexcept { return of(0x700, node_id); }

/// The node-id that a COB-ID of the set carries; 0 for NMT and SYNC.
[[nodiscard]] constexpr std::uint8_t node_of(std::uint16_t id) noexcept { return static_cast<std::uint8_t>(id & 0x7F); }

// Bits of the COB-ID entries 1400h:1 and 1800h:1.
inline constexpr std::uint32_t kPdoInvalid = 0x8000'0000;
inline constexpr std::uint32_t kPdoNoRemote = 0x4000'0000;
/// Which bits must read back as written: drives may keep the remote bit as they like.
inline constexpr std::uint32_t kPdoCompared = ~kPdoNoRemote;

// Of the COB-ID entry 1005h, all but its bit 31, which says nothing: bit 30 is set in the node that produces SYNC.
inline constexpr std::uint32_t kSyncCompared = 0x7FFF'FFFF;

}  // namespace ivo::drivers::cob_id
