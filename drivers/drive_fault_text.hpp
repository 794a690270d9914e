// A drive's fault in words. Outside of the loop only: it allocates.
#pragma once

#include <string>

#include "drivers/drive_fault.hpp"

namespace ivo::drivers {

/// One line for a person, as: drive 3 (rear left) failed at "mode of operation 6061h": SDO abort 06090030h, value range
/// exceeded.
[[nodiscard]] std::string describe(const DriveFault& fault);

}  // namespace ivo::drivers
