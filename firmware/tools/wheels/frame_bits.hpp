// How many bits a frame takes on the bus.
#pragma once

#include <cstdint>

#include "hal/api/can_frame.hpp"

namespace ivo::firmware {

/// A base-format data frame from start of frame to the third bit of intermission, with the stuff bits that its contents
/// and its CRC need (ISO 11898-1, 10.4 and 10.5). Cost: some 100 steps.
[[nodiscard]] int frame_bits(const hal::CanFrame& frame) noexcept;

}  // namespace ivo::firmware
