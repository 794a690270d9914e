// Times as people read them in reports.
#pragma once

#include "config/base/time.hpp"

namespace ivo::firmware {

[[nodiscard]] inline double us(Duration time) { return static_cast<double>(time.count()) / 1e3; }

}  // namespace ivo::firmware
