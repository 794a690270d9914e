// What the cycles of a run cost, as a document for programs: `ivo run --stats FILE`.
#pragma once

#include <string>

#include "firmware/loop/loop_status.hpp"
#include "firmware/loop/phase_times.hpp"
#include "hal/linux/real_time.hpp"

namespace ivo::firmware {

struct RunStats {
  const LoopStatus& status;
  const PhaseTimes& times;
  hal::PageFaults page_faults;
  std::string clock;  ///< what times were taken with
};

/// Times in ns: median, p99 and p99.9 good to a sixteenth, worst exact; counts of cycles, lost periods, page faults,
/// frames.
[[nodiscard]] std::string stats_json(const RunStats& stats);

}  // namespace ivo::firmware
