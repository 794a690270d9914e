// What records of a run have for time, and what becomes of those of the run before.
#pragma once

#include <chrono>

#include "config/base/time.hpp"
#include "firmware/record/record_file.hpp"
#include "firmware/tools/run_options.hpp"
#include "firmware/tools/run_world.hpp"

namespace ivo::firmware {

/// What a reader's clock says at Instant{}: zero for simulated time, else the clock on the wall. To be sampled once: a
/// wall clock that is set meanwhile bends no record.
[[nodiscard]] Duration record_epoch(const RunOptions& options, RunWorld& world);

/// How often a record is written out where time does not wait for it, which is what a kill can lose.
[[nodiscard]] std::chrono::milliseconds record_every(const RunOptions& options);

/// A run that may go on with another's search keeps what that one recorded.
[[nodiscard]] RecordFile::Earlier earlier_record(const RunOptions& options);

}  // namespace ivo::firmware
