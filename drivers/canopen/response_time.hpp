// How long a frame may take from being queued to being on the other side, when everything that can come before it does.
// R. I. Davis, A. Burns, R. J. Bril, J. J. Lukkien: Controller Area Network (CAN) schedulability analysis: Refuted,
// revisited and revised. Real-Time Systems 35, 2007: equations 4 to 12.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "config/base/static_vector.hpp"
#include "config/base/time.hpp"
#include "drivers/canopen/bus_load.hpp"

namespace ivo::drivers {

struct ResponseTime {
  PeriodicFrame frame;
  /// From the beginning of the frame's period to its last bit; none when more is asked of the bus than it carries.
  std::optional<Duration> worst;
};
using ResponseTimes = StaticVector<ResponseTime, BusSchedule::capacity()>;

/// Of each of `schedule`, by priority. Every frame is as long as stuffing can make it, none is disturbed and sent
/// again, and every node sends the lowest COB-ID that it has first. Just before, a frame of lower priority may have
/// begun: of the schedule, or one of `other_bytes` (an SDO, say; none: there are no others). A frame after SYNC is
/// queued when SYNC has arrived; what its node takes to answer comes on top.
[[nodiscard]] ResponseTimes response_times(const BusSchedule& schedule, std::uint32_t bit_rate_bps,
                                           std::optional<std::uint8_t> other_bytes = 8) noexcept;

}  // namespace ivo::drivers
