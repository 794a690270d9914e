// Mission files: config/missions/*.toml into config/mission.hpp.
#pragma once

#include <string>

#include "config/base/result.hpp"
#include "config/mission.hpp"
#include "firmware/files/lines.hpp"

namespace ivo::firmware {

struct MissionFile {
  std::string path;
  Mission mission;  ///< paths in it are as seen from where the program runs
  Lines lines;  ///< for complaints that need the map: lines.at("agent[1].start_m", "lies in an obstacle; expected ...")
};

/// Keys as config/missions/courtyard.toml shows; what may be left out has the default of config/mission.hpp. Refuses,
/// by file, line and key: what is missing, unknown, misplaced, of the wrong type or out of range; agents that are not
/// one robot and then persons, of different names; areas that are not simple polygons. What needs the map is for the
/// planner: starts in obstacles, areas without mass.
[[nodiscard]] Result<MissionFile> read_mission(const std::string& path);

}  // namespace ivo::firmware
