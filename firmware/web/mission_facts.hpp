// What the server itself needs to know of a mission: of the controller's document.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"

namespace ivo::firmware::web {

struct MissionFacts {
  int width_px = 0;
  int height_px = 0;
  double resolution_m = 0.0;
  Point origin_m;                   ///< of the map's lower-left corner, in the frame of ROS
  std::vector<bool> obstacle;       ///< by class
  std::vector<std::string> agents;  ///< their names
};

/// None when it is no such document.
[[nodiscard]] std::optional<MissionFacts> mission_facts(const std::string& document);

}  // namespace ivo::firmware::web
