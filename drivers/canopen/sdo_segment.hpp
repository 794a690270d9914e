// SDO segments on the wire: what does not fit into one frame goes in pieces of up to seven bytes, each confirmed, with
// a toggle bit that tells a repeated piece from the next one (CiA 301, 7.2.4.3.4 and 7.2.4.3.7).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/sdo_frame.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

namespace sdo_command {
inline constexpr std::uint8_t kSegmentedDownload = kDownload | kSizeGiven;  // 21h, initiates: the data is its size
inline constexpr std::uint8_t kSegmentedUpload = kUpload | kSizeGiven;      // 41h, answer: ditto; 40h: size not given
inline constexpr std::uint8_t kUploadSegment = 0x60;                        // request
inline constexpr std::uint8_t kUploadedSegment = 0x00;                      // its answer
inline constexpr std::uint8_t kDownloadSegment = 0x00;                      // request
inline constexpr std::uint8_t kDownloadedSegment = 0x20;                    // its answer
inline constexpr std::uint8_t kToggle = 0x10;
inline constexpr std::uint8_t kLast = 0x01;
}  // namespace sdo_command

inline constexpr std::size_t kSegmentBytes = 7;

/// A segment that carries data: from client to server in a download, from server to client in an upload.
struct SdoSegment {
  bool toggle = false;  ///< false in the first one
  bool last = false;
  std::uint8_t bytes = 0;  ///< of data, 0 to 7
  std::array<std::uint8_t, kSegmentBytes> data{};
};

[[nodiscard]] constexpr hal::CanFrame sdo_segment_frame(std::uint16_t id, const SdoSegment& segment) noexcept {
  hal::CanFrame frame{.id = id, .size = 8, .data = {}};
  frame.data[0] =
      static_cast<std::uint8_t>((segment.toggle ? sdo_command::kToggle : 0) | (kSegmentBytes - segment.bytes) << 1 |
                                (segment.last ? sdo_command::kLast : 0));
  std::copy_n(segment.data.begin(), segment.bytes, frame.data.begin() + 1);
  return frame;
}

/// Of a frame of eight bytes whose service is kUploadedSegment or kDownloadSegment.
[[nodiscard]] constexpr SdoSegment parse_sdo_segment(const hal::CanFrame& frame) noexcept {
  const std::uint8_t command = frame.data[0];
  SdoSegment segment{.toggle = (command & sdo_command::kToggle) != 0,
                     .last = (command & sdo_command::kLast) != 0,
                     .bytes = static_cast<std::uint8_t>(kSegmentBytes - ((command >> 1) & 7U)),
                     .data = {}};
  std::copy_n(frame.data.begin() + 1, kSegmentBytes, segment.data.begin());
  return segment;
}

/// A segment that carries none: the request of an upload, the confirmation of a download.
[[nodiscard]] constexpr hal::CanFrame sdo_segment_frame(std::uint16_t id, std::uint8_t service, bool toggle) noexcept {
  return {.id = id, .size = 8, .data = {static_cast<std::uint8_t>(service | (toggle ? sdo_command::kToggle : 0))}};
}

}  // namespace ivo::drivers
