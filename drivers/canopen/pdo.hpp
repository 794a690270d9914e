// What a wheel drive's process data objects carry, and its frames. Which COB-IDs they have, pdo_layout.hpp says.
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
inline constexpr std::uint8_t kControlwordBytes = 2;
inline constexpr std::uint8_t kTargetPairBytes = 8;
inline constexpr std::uint8_t kEverySync = 1;  ///< transmission type

struct DriveCommand {
  std::uint16_t controlword = 0;
  std::int32_t target_velocity = 0;  ///< in the drive's units
};

/// TPDO {6041h:16, 6064h:32}. The drive's velocity 606Ch is not mapped: from positions a lost frame loses no distance.
struct DriveStatus {
  std::uint16_t statusword = 0;
  std::int32_t position = 0;  ///< counts, wraps
};

/// Targets of two drives, in the order of their dummy entries.
struct TargetPair {
  std::int32_t first = 0;
  std::int32_t second = 0;
};

/// RPDO {6040h:16, 60FFh:32}.
[[nodiscard]] constexpr hal::CanFrame command_frame(std::uint16_t id, const DriveCommand& command) noexcept {
  hal::CanFrame frame{.id = id, .size = kPdoBytes, .data = {}};
  const std::span<std::uint8_t> bytes(frame.data);
  store(bytes, command.controlword);
  store(bytes.subspan(2), std::bit_cast<std::uint32_t>(command.target_velocity));
  return frame;
}

/// RPDO {6040h:16}.
[[nodiscard]] constexpr hal::CanFrame controlword_frame(std::uint16_t id, std::uint16_t controlword) noexcept {
  hal::CanFrame frame{.id = id, .size = kControlwordBytes, .data = {}};
  store(std::span<std::uint8_t>(frame.data), controlword);
  return frame;
}

/// RPDO {60FFh:32, dummy:32} of the first drive and {dummy:32, 60FFh:32} of the second, which both take it.
[[nodiscard]] constexpr hal::CanFrame target_pair_frame(std::uint16_t id, const TargetPair& targets) noexcept {
  hal::CanFrame frame{.id = id, .size = kTargetPairBytes, .data = {}};
  const std::span<std::uint8_t> bytes(frame.data);
  store(bytes, std::bit_cast<std::uint32_t>(targets.first));
  store(bytes.subspan(4), std::bit_cast<std::uint32_t>(targets.second));
  return frame;
}

/// None when the frame is not as long as the mapping: then nothing in it can be trusted.
[[nodiscard]] constexpr std::optional<DriveStatus> parse_status(const hal::CanFrame& frame) noexcept {
  if (frame.size != kPdoBytes) {
    return std::nullopt;
  }
  const std::span<const std::uint8_t> bytes(frame.data);
  return DriveStatus{load<std::uint16_t>(bytes), std::bit_cast<std::int32_t>(load<std::uint32_t>(bytes.subspan(2)))};
}

/// None when the frame has another length. The opposite of target_pair_frame.
[[nodiscard]] constexpr std::optional<TargetPair> parse_target_pair(const hal::CanFrame& frame) noexcept {
  if (frame.size != kTargetPairBytes) {
    return std::nullopt;
  }
  const std::span<const std::uint8_t> bytes(frame.data);
  return TargetPair{std::bit_cast<std::int32_t>(load<std::uint32_t>(bytes)),
                    std::bit_cast<std::int32_t>(load<std::uint32_t>(bytes.subspan(4)))};
}

}  // namespace ivo::drivers
