// The areas that people have drawn, in the run's folder: a run that takes up a search that was cut off has them again.
#pragma once

#include <string>

#include "config/base/result.hpp"
#include "config/mission.hpp"
#include "firmware/console/area_board.hpp"
#include "firmware/console/console_desk.hpp"

namespace ivo::firmware {

/// As GeoJSON (firmware/files/geojson_file.hpp), whole or not at all.
[[nodiscard]] Result<void> keep_areas(const std::string& path, const console::AreaBoard& board, const Mission& mission);

/// Draws what was kept. Where nothing was, false and nothing is drawn; refuses what is no such file.
[[nodiscard]] Result<bool> draw_kept_areas(const std::string& path, const Mission& mission, console::ConsoleDesk& desk);

}  // namespace ivo::firmware
