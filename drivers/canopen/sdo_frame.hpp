// SDO on the wire: eight bytes, always: command, index, sub-index, four bytes of data (CiA 301, 7.2.4.3).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drivers/canopen/little_endian.hpp"
#include "drivers/canopen/object_address.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

namespace sdo_command {
inline constexpr std::uint8_t kServiceMask = 0xE0;
inline constexpr std::uint8_t kExpedited = 0x02;
inline constexpr std::uint8_t kSizeGiven = 0x01;

inline constexpr std::uint8_t kDownload = 0x20;    // request; its answer is kDownloaded
inline constexpr std::uint8_t kUpload = 0x40;      // request, and with size bits its answer
inline constexpr std::uint8_t kDownloaded = 0x60;  // answer
inline constexpr std::uint8_t kAbort = 0x80;       // both ways

/// `service` with `bytes`, 1 to 4, carried in the frame: 2Fh 2Bh 27h 23h or 4Fh 4Bh 47h 43h.
[[nodiscard]] constexpr std::uint8_t expedited(std::uint8_t service, std::uint8_t bytes) noexcept {
  return static_cast<std::uint8_t>(service | (4 - bytes) << 2 | kExpedited | kSizeGiven);
}

/// Bytes carried by an expedited command; none when it does not say (22h, 42h).
[[nodiscard]] constexpr std::optional<std::uint8_t> bytes_in(std::uint8_t command) noexcept {
  if ((command & kSizeGiven) == 0) {
    return std::nullopt;
  }
  return static_cast<std::uint8_t>(4 - ((command >> 2) & 3));
}
}  // namespace sdo_command

struct SdoMessage {
  std::uint8_t command = 0;
  ObjectAddress address;
  std::uint32_t data = 0;
};

[[nodiscard]] constexpr hal::CanFrame sdo_frame(std::uint16_t id, const SdoMessage& message) noexcept {
  hal::CanFrame frame{.id = id, .size = 8, .data = {message.command}};
  const std::span<std::uint8_t> bytes(frame.data);
  store(bytes.subspan(1), message.address.index);
  frame.data[3] = message.address.sub;
  store(bytes.subspan(4), message.data);
  return frame;
}

/// None when the frame is not eight bytes long.
[[nodiscard]] constexpr std::optional<SdoMessage> parse_sdo(const hal::CanFrame& frame) noexcept {
  if (frame.size != 8) {
    return std::nullopt;
  }
  const std::span<const std::uint8_t> bytes(frame.data);
  return SdoMessage{
      frame.data[0], {load<std::uint16_t>(bytes.subspan(1)), frame.data[3]}, load<std::uint32_t>(bytes.subspan(4))};
}

/// The lowest `bytes` of `data`.
[[nodiscard]] constexpr std::uint32_t low_bytes(std::uint32_t data, std::uint8_t bytes) noexcept {
  return bytes >= 4 ? data : data & ((std::uint32_t{1} << (8 * bytes)) - 1);
}

}  // namespace ivo::drivers
