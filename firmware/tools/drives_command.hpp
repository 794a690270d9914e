// `ivo-drives`: the robot's four wheel drives, simulated, on a CAN interface.
#pragma once

#include <atomic>
#include <iosfwd>
#include <span>
#include <string>

#include "config/base/result.hpp"
#include "drivers/sim/sim_drives.hpp"

namespace ivo::firmware {

struct DrivesOptions {
  std::string interface;    ///< --can, required
  std::string robot_path;   ///< --robot; empty: the built-in IVO-class base
  std::string eds_path;     ///< --eds; empty: each drive's of the robot file, else the built-in one
  std::string script_path;  ///< --script; empty: nothing goes wrong
  std::string log_path;     ///< --log; empty: none
  drivers::SimDrives::TimeFrom time_from = drivers::SimDrives::TimeFrom::kClock;  ///< --clock real|sync
  bool help = false;  ///< --help: nothing else was looked at
};

[[nodiscard]] const char* drives_usage() noexcept;

/// Arguments as main has them, the program's name left out.
[[nodiscard]] Result<DrivesOptions> parse_drives_options(std::span<const char* const> arguments);

/// Runs until `stop`, which a signal sets; one line to `out` when ready and one at the end. Refuses what is wrong with
/// the files or the interface before anything is sent.
[[nodiscard]] Result<void> run_drives(const DrivesOptions& options, const std::atomic<bool>& stop, std::ostream& out);

}  // namespace ivo::firmware
