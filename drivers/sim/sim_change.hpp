// What is worth a line in the log of a simulated drive.
#pragma once

#include <cstdint>

#include "config/base/time.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/cia402/statusword.hpp"

namespace ivo::drivers {

/// One of the states is another than before, or the wheel came to rest or began to turn.
struct SimChange {
  Instant at{};  ///< the drive's time
  NmtState nmt = NmtState::kBootUp;
  cia402::PowerState power = cia402::PowerState::kSwitchOnDisabled;
  std::int32_t velocity = 0;  ///< of the motor, in the drive's units
  bool at_rest = true;
};

}  // namespace ivo::drivers
