// A line of the log of a simulated drive.
#pragma once

#include <cstdint>
#include <string>

#include "drivers/sim/sim_change.hpp"

namespace ivo::drivers {

/// "t_s=12.345000 node=3 nmt=operational power=operation_enabled velocity=-120 wheel=turns", without a line break.
/// wheel is "turns" or "rests".
[[nodiscard]] std::string describe(std::uint8_t node_id, const SimChange& change);

}  // namespace ivo::drivers
