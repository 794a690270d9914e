// Areas of a file, as commands that draw them.
#pragma once

#include <string>
#include <vector>

#include "firmware/console/console_messages.hpp"
#include "firmware/files/geojson_file.hpp"

namespace ivo::firmware {

/// In the file's order; an area that names no slot gets the lowest that no other has. `names`: of the mission's agents;
/// each area's is among them.
[[nodiscard]] std::vector<console::AreaCommand> area_commands(const std::vector<DrawnArea>& areas,
                                                              const std::vector<std::string>& names);

}  // namespace ivo::firmware
