// SYNC without counter (CiA 301, 7.2.5).
#pragma once

#include "drivers/canopen/cob_id.hpp"
#include "hal/api/can_frame.hpp"

namespace ivo::drivers {

[[nodiscard]] constexpr hal::CanFrame sync_frame() noexcept { return {.id = cob_id::kSync, .size = 0, .data = {}}; }

}  // namespace ivo::drivers
