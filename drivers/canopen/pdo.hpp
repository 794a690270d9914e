// The two process data objects of a wheel drive, in the layout that start-up maps: six bytes each, at every SYNC.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/little_endian.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

inline constexpr std::uint8_t kPdoBytes = 6;
inline constexpr std::uint8_t kEverySync = 1;  ///< transmission type

/// RPDO1: {6040h:16, 60FFh:32}.
struct DriveCommand {
  std::uint16_t controlword = 0;
  std::int32_t target_velocity = 0;  ///< in the drive's units
};

/// TPDO1: {6041h:16, 6064h:32}. The drive's velocity 606Ch is not mapped: from positions a lost frame loses no
/// distance.
struct DriveStatus {
  std::uint16_t statusword = 0;
  std::int32_t position = 0;  ///< counts, wraps
};

[[nodiscard]] constexpr hal::CanFrame rpdo1_frame(std::uint8_t node_id, const DriveCommand& command) noexcept {
  hal::CanFrame frame{.id = cob_id::rpdo1(node_id), .size = kPdoBytes, .data = {}};
  const std::span<std::uint8_t> bytes(frame.data);
  store(bytes, command.controlword);
  store(bytes.subspan(2), std::bit_cast<std::uint32_t>(command.target_velocity));
  return frame;
}

/// None when the frame is not as long as the mapping: then nothing in it can be trusted.
[[nodiscard]] constexpr std::optional<DriveStatus> parse_tpdo1(const hal::CanFrame& frame) noexcept {
  if (frame.size != kPdoBytes) {
    return std::nullopt;
  }
  const std::span<const std::uint8_t> bytes(frame.data);
  return DriveStatus{load<std::uint16_t>(bytes), std::bit_cast<std::int32_t>(load<std::uint32_t>(bytes.subspan(2)))};
}

}  // namespace ivo::drivers
