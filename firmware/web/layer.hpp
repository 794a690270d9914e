// What other programs see and publish, as a page shows it over its map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/time.hpp"

namespace ivo::firmware::web {

enum class LayerName : std::uint8_t { kScan, kPeople, kRobotPose };
inline constexpr int kLayers = 3;

struct Layer {
  static constexpr std::size_t kMostPoints = 2000;

  LayerName name{};
  Instant at{};               ///< when this was so, on the server's clock
  std::vector<Point> points;  ///< in the map's frame, at most kMostPoints; one of a robot's pose
  double heading_rad = 0.0;   ///< of a robot's pose
};

}  // namespace ivo::firmware::web
