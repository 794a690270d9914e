#include "firmware/web/ros/ros_grids.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "firmware/files/keepout_mask.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::int8_t kOccupied = 100;

}  // namespace

std::vector<std::int8_t> occupancy_of(const std::string& map, const RosMission& mission) {
  std::vector<std::int8_t> values;
  if (map.size() == mission.pixels()) {
    values.reserve(map.size());
    for (const char pixel : map) {
      const auto kind = static_cast<unsigned char>(pixel);
      values.push_back(kind < mission.obstacle.size() && !mission.obstacle[kind] ? std::int8_t{0} : kOccupied);
    }
  }
  return values;
}

std::vector<std::int8_t> keepout_grid_of(const std::string& map, const RosMission& mission,
                                         const std::vector<RosArea>& areas) {
  std::vector<std::int8_t> values = occupancy_of(map, mission);
  std::vector<Polygon> no_go;
  for (const RosArea& area : areas) {
    if (area.no_go && area.agent.value_or(0) == 0) {  // a person's are open to the robot
      no_go.push_back(area.polygon);
    }
  }
  if (!values.empty()) {
    const std::string within = pixels_within(mission.width_px, mission.height_px, mission.resolution_m, no_go);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = within[i] != 0 ? kOccupied : values[i];
    }
  }
  return values;
}

std::vector<float> masses_of(const std::string& probability, const RosMission& mission) {
  std::vector<float> masses;
  if (probability.size() == mission.cells() * sizeof(float)) {
    masses.resize(mission.cells());
    std::memcpy(masses.data(), probability.data(), probability.size());
  }
  return masses;
}

std::vector<float> belief_of(std::vector<float> masses, const std::string& searched) {
  double left = 0.0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const unsigned byte = i / 8 < searched.size() ? static_cast<unsigned char>(searched[i / 8]) : 0U;
    masses[i] = (byte >> (i % 8) & 1U) != 0 ? 0.0F : masses[i];
    left += static_cast<double>(masses[i]);
  }
  for (float& mass : masses) {
    mass = left > 0 ? static_cast<float>(static_cast<double>(mass) / left) : 0.0F;
  }
  return masses;
}

std::vector<std::int8_t> percent_of_most(const std::vector<float>& values) {
  float most = 0.0F;
  for (const float value : values) {
    most = std::max(most, value);
  }
  std::vector<std::int8_t> percent(values.size(), 0);
  for (std::size_t i = 0; i < values.size() && most > 0.0F; ++i) {
    percent[i] = static_cast<std::int8_t>(std::lround(100.0F * std::clamp(values[i] / most, 0.0F, 1.0F)));
  }
  return percent;
}

}  // namespace ivo::firmware::web
