// What a ROS client's session needs to know of the mission, from the controller's document.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/geometry.hpp"

namespace ivo::firmware::web {

struct RosAgent {
  std::string name;   ///< as the mission has it
  std::string token;  ///< as topics have it: letters, digits and single underscores; no two agents the same
  bool person = false;
};

struct RosMission {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  double resolution_m = 0.0;
  int columns = 0;
  int rows = 0;
  double cell_m = 0.0;
  Point origin_m;              ///< of our frame in the frame that ROS has of the map
  std::vector<bool> obstacle;  ///< by class of the map
  std::vector<RosAgent> agents;

  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
  [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  [[nodiscard]] Point to_ros(Point p) const { return {p.x_m + origin_m.x_m, p.y_m + origin_m.y_m}; }
  [[nodiscard]] Point from_ros(Point p) const { return {p.x_m - origin_m.x_m, p.y_m - origin_m.y_m}; }
  [[nodiscard]] std::optional<std::size_t> agent_of(std::string_view token) const;
};

/// None when it is no mission document.
[[nodiscard]] std::optional<RosMission> mission_of(const std::string& document);

/// A name as a part of a topic's: what is neither letter nor digit becomes one underscore.
[[nodiscard]] std::string topic_token(std::string_view name);

}  // namespace ivo::firmware::web
