// What simulated drives did, a line each time it changed: for tests that must know when wheels stood.
#pragma once

#include <fstream>
#include <string>

#include "config/base/result.hpp"
#include "drivers/sim/sim_drives.hpp"

namespace ivo::firmware {

class DrivesLog {
 public:
  /// Empties the file. An empty path: nothing is logged.
  [[nodiscard]] Result<void> open(const std::string& path);
  /// The lines since the last call (sim_change_text.hpp), each flushed. A disk that is full is no reason to stop.
  void write(drivers::SimDrives& drives);

 private:
  std::ofstream file_;
};

}  // namespace ivo::firmware
