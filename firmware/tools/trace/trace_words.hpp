// The words of this robot's traces.
#pragma once

#include "config/robot.hpp"
#include "firmware/files/mission_file.hpp"
#include "firmware/record/trace_names.hpp"

namespace ivo::firmware {

[[nodiscard]] TraceNames trace_words(const Robot& robot, const Mission& mission);

}  // namespace ivo::firmware
