// The table [inputs] of a robot file: emergency stop and bumpers.
#pragma once

#include "config/robot.hpp"
#include "firmware/files/toml_table.hpp"

namespace ivo::firmware {

/// An absent table: no inputs. Refuses a table without any input, and a line that is used twice. The level of each line
/// must be said: a stop that works only when it is not needed must not come of a default.
[[nodiscard]] InputParameters read_inputs(const TomlValue& table);

}  // namespace ivo::firmware
