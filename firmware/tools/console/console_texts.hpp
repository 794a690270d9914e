// What a controller that runs shows, for a person at a terminal.
#pragma once

#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/console/console_messages.hpp"
#include "firmware/files/json_value.hpp"

namespace ivo::firmware {

[[nodiscard]] std::string mode_text(const console::Status& status);
[[nodiscard]] std::string asks_text(const console::Status& status);
/// What a person at the controller's terminal is told before the question.
void warn_of_pose(const console::Status& status);
void show_status(const console::Status& status, const std::vector<std::string>& names);
/// The plan beside the one before; each null when there is none.
void show_plans(const Json& plan, const Json& previous, const std::vector<std::string>& names);
void show_areas(const Json& areas, const std::vector<std::string>& names);

}  // namespace ivo::firmware
