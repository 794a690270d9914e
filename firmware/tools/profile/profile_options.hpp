// What `ivo profile` was asked on the command line.
#pragma once

#include "firmware/tools/run_options.hpp"

namespace ivo::firmware {

struct ProfileOptions {
  RunOptions run;              ///< of it mission, speed, trace, log and trace_marker
  bool planning_only = false;  ///< ends once the plan is ready
};

/// Runs a mission on the virtual bus, where nothing real moves, and says where the time of its cycles went. Returns the
/// exit status: 0 measured, 1 it ended otherwise than planned, 2 wrong input.
[[nodiscard]] int profile(const ProfileOptions& options);

}  // namespace ivo::firmware
