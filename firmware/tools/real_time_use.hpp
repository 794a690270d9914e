// Whether a run's loop is real time on this machine, decided once before anything opens and said to the person.
#pragma once

#include <optional>
#include <string>

#include "config/base/result.hpp"
#include "config/robot.hpp"
#include "firmware/tools/run_world.hpp"
#include "hal/linux/real_time.hpp"

namespace ivo::firmware {

struct RealTimeUse {
  std::optional<hal::RealTimePlace> place;  ///< none: ordinary scheduling
  std::string text;                         ///< for a person; empty where time is simulated
};

/// Locks memory and tries the loop's priority and CPU. Fails on a real interface when either is refused, unless
/// `without` (--no-real-time) asks for the degraded mode.
[[nodiscard]] Result<RealTimeUse> real_time_use(RunWorld::Time time, const LoopParameters& loop, bool without);

}  // namespace ivo::firmware
