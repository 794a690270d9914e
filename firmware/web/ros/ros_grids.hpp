// The controller's grids as ROS shows them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/web/ros/ros_documents.hpp"
#include "firmware/web/ros/ros_mission.hpp"

namespace ivo::firmware::web {

/// 100 of an obstacle, else 0; a value a pixel. Empty when `map` has another size than the mission says.
[[nodiscard]] std::vector<std::int8_t> occupancy_of(const std::string& map, const RosMission& mission);

/// The map's occupancy, and 100 too where a pixel's centre lies in a no-go area: a costmap filter mask of Nav2.
[[nodiscard]] std::vector<std::int8_t> keepout_grid_of(const std::string& map, const RosMission& mission,
                                                       const std::vector<RosArea>& areas);

/// The masses of the cells. Empty when `probability` has another size than the mission says.
[[nodiscard]] std::vector<float> masses_of(const std::string& probability, const RosMission& mission);
/// What is left of them where nobody has looked, sum 1 again; all 0 when nothing is left.
[[nodiscard]] std::vector<float> belief_of(std::vector<float> masses, const std::string& searched);

/// 0 to 100, the greatest value 100; the cells' order stays.
[[nodiscard]] std::vector<std::int8_t> percent_of_most(const std::vector<float>& values);

}  // namespace ivo::firmware::web
