// The loop's status as the console's clients read it.
#pragma once

#include "firmware/console/console_messages.hpp"
#include "firmware/loop/loop_status.hpp"

namespace ivo::firmware::console {

/// `agents`: of the mission. Outside the loop: a fault is put into words. What the socket adds is left as it is.
[[nodiscard]] Status status_of(const LoopStatus& loop, int agents);

}  // namespace ivo::firmware::console
