// What tracing costs, measured beside a run.
#pragma once

#include "hal/api/clock.hpp"

namespace ivo::firmware {

/// Nanoseconds that one event takes out of a cycle: the median of some bursts of a cycle's events into a ring of its
/// own, cold as the ring of a run is. Cost: some milliseconds.
[[nodiscard]] double measured_event_cost_ns(hal::Clock& stopwatch);

}  // namespace ivo::firmware
