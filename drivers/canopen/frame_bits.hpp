// How long a data frame with an 11-bit identifier is on the wire, in bits (ISO 11898-1, 10.4 and 10.5).
#pragma once

#include <cstdint>
#include <span>

#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

/// Of a frame with `bytes` of data, 0 to 8, without stuff bits, and the three bits of silence after it.
[[nodiscard]] constexpr int unstuffed_bits(int bytes) noexcept { return 47 + 8 * bytes; }

/// Of the longest such frame: a stuff bit counts towards the next five, so after the first at every fourth bit of the
/// 34 + 8n from start of frame to the end of the CRC.
[[nodiscard]] constexpr int longest_bits(int bytes) noexcept { return unstuffed_bits(bytes) + (33 + 8 * bytes) / 4; }

/// Of this very frame: with its CRC and its stuff bits, and the three bits of silence after it.
[[nodiscard]] int bits_on_wire(const hal::CanFrame& frame) noexcept;

/// CRC-15 of CAN, polynomial 4599h, over bits as they are sent.
[[nodiscard]] std::uint16_t can_crc(std::span<const bool> bits) noexcept;

}  // namespace ivo::drivers
