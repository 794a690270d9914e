#include "firmware/tools/drives_log.hpp"

#include <ostream>

#include "drivers/sim/sim_change_text.hpp"

namespace ivo::firmware {

Result<void> DrivesLog::open(const std::string& path) {
  if (path.empty()) {
    return {};
  }
  file_.open(path, std::ios::trunc);
  if (!file_) {
    return Error{"--log " + path + ": cannot be written; expected a file in a folder that is there"};
  }
  return {};
}

void DrivesLog::write(drivers::SimDrives& drives) {
  for (int wheel = 0; wheel < kWheels; ++wheel) {
    drivers::SimDrive& drive = drives.drive(static_cast<Wheel>(wheel));
    for (const drivers::SimChange& change : drive.changes()) {
      if (file_.is_open()) {
        file_ << drivers::describe(drive.node_id(), change) << std::endl;
      }
    }
    drive.forget_changes();
  }
}

}  // namespace ivo::firmware
