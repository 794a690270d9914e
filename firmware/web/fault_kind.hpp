// What a person beside the robot can make of a fault: where to look. The reason itself is for who mends it.
#pragma once

#include <string_view>

#include "drivers/drive_fault.hpp"

namespace ivo::firmware::web {

/// `none`, `start_up`, `drive`, `silent`, `power`, `wheel`, `slip`, `wiring`, `computer`, `stop_input`; of a reason
/// that this program does not know, `unknown`.
[[nodiscard]] std::string_view fault_kind(drivers::DriveFaultReason reason) noexcept;

}  // namespace ivo::firmware::web
