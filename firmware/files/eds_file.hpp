// EDS files (CiA 306) into drivers/eds/eds_dictionary.hpp.
#pragma once

#include <memory>
#include <string>

#include "config/base/result.hpp"
#include "config/robot.hpp"
#include "drivers/eds/eds_dictionary.hpp"

namespace ivo::firmware {

/// On the heap, for it is large. Refuses what cannot be read, by path, and what is wrong, by path, line, section and
/// key: what was found and what is expected.
[[nodiscard]] Result<std::unique_ptr<drivers::EdsDictionary>> read_eds_file(const std::string& path);

/// The same, and refuses what no simulated wheel drive can be made of.
[[nodiscard]] Result<std::unique_ptr<drivers::EdsDictionary>> read_simulated_eds(const std::string& path);

/// Whether the drive of `wheel`, as its EDS (DriveParameters::eds) describes it, has what start-up reads and writes;
/// true without an EDS. The complaint names the file, the object, what is wrong and the step of start-up.
[[nodiscard]] Result<void> check_drive_eds(const Robot& robot, Wheel wheel);

}  // namespace ivo::firmware
