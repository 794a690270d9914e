// The object dictionary of a simulated wheel drive, with its defaults.
#pragma once

#include "config/robot.hpp"
#include "drivers/sim/object_dictionary.hpp"
#include "drivers/sim/sim_script.hpp"

namespace ivo::drivers {

inline constexpr std::uint8_t kSimMappingEntries = 4;  ///< of each PDO

/// As shipped: both PDOs valid and event-driven with nothing mapped, no heartbeat, ramps of 50 rad/s2 and, for the
/// quick stop, 100 rad/s2 at the wheel.
[[nodiscard]] ObjectDictionary sim_objects(const DriveParameters& drive, const SimScript& script) noexcept;

}  // namespace ivo::drivers
