// Areas of a GeoJSON file, drawn at the console of a controller that runs.
#pragma once

#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/console/console_client.hpp"
#include "firmware/files/geojson_file.hpp"

namespace ivo::firmware {

/// `names`: of the mission's agents. `slot`: where it is drawn when the file does not say.
[[nodiscard]] console::AreaCommand command_of(const DrawnArea& area, const std::vector<std::string>& names,
                                              std::uint8_t slot);

/// The areas of `path` take the place of those that are drawn. Refuses what geojson_file.hpp refuses, before anything
/// is drawn, and what the controller refuses, by feature.
[[nodiscard]] Result<void> draw_file(console::ConsoleClient& client, const std::string& path,
                                     const std::vector<std::string>& names);

}  // namespace ivo::firmware
