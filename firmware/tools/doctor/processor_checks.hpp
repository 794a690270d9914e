// Is there a CPU for the loop alone, always awake and at full speed?
#pragma once

#include <optional>
#include <string>

#include "firmware/tools/doctor/finding.hpp"
#include "firmware/tools/doctor/machine_files.hpp"

namespace ivo::firmware::doctor {

/// Where the loop will run, and what is to be looked at. Isolated CPUs are for those who bind themselves: a loop that
/// is bound to none never comes to one.
struct LoopCpu {
  std::optional<int> bound;     ///< that the loop binds itself to: cpu under [loop] of the robot file
  std::optional<int> examined;  ///< bound, or another that was asked for; none: all together
  std::string robot_file = "the robot file";
};

/// Time lost in leaving an idle state is a latency: kWakeUpUs at most.
inline constexpr int kWakeUpUs = 50;
[[nodiscard]] Group processor_checks(const MachineFiles& files, const LoopCpu& loop);

}  // namespace ivo::firmware::doctor
