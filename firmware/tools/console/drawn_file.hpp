// Areas of a GeoJSON file, drawn at the console of a controller that runs.
#pragma once

#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/console/console_client.hpp"

namespace ivo::firmware {

/// `names`: of the mission's agents. The areas of `path` take the place of those that are drawn. Refuses what
/// geojson_file.hpp refuses, before anything is drawn, and what the controller refuses, by feature.
[[nodiscard]] Result<void> draw_file(console::ConsoleClient& client, const std::string& path,
                                     const std::vector<std::string>& names);

}  // namespace ivo::firmware
