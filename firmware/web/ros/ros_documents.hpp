// The controller's plan and areas as a session needs them. What is no such document reads as an empty one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/mission.hpp"

namespace ivo::firmware::web {

/// Of each agent in the mission's order.
[[nodiscard]] std::vector<std::vector<Point>> waypoints_of(const std::string& plan);

struct RosArea {
  std::uint8_t slot = 0;
  bool no_go = false;
  std::optional<std::size_t> agent;  ///< none: everybody
  Polygon polygon;
};
[[nodiscard]] std::vector<RosArea> areas_of(const std::string& areas);

}  // namespace ivo::firmware::web
