// A segmented map: a PNG of class colours, its resolution and its class table, from two small TOML files; or an
// occupancy grid as ROS keeps it.
#pragma once

#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "config/semantic_class.hpp"
#include "planner/world/segmented_map.hpp"

namespace ivo::firmware {

struct MapFile {
  std::string path;
  std::string image_path;
  std::string classes_path;  ///< of the class table; empty: the built-in one
  std::string aerial_path;   ///< the same ground as seen from above, for people; empty: there is none
  std::string aerial;        ///< the PNG at aerial_path, whole
  int width_px = 0;
  int height_px = 0;
  double resolution_m = 0.0;
  Point origin_m;  ///< of our frame, the map's lower-left corner, in the frame that ROS has of it; (0, 0) of a .toml
  ClassTable classes{};
  std::vector<SemanticClass> pixels;  ///< row by row, the bottom row first

  /// Valid while this object lives and stays unchanged.
  [[nodiscard]] planner::SegmentedMap view() const;
};

/// Of a path that ends in .yaml or .yml: a map of ROS (firmware/files/ros_map_file.hpp). Else TOML with the keys image,
/// resolution_m, optional classes (a class table; the built-in one without it) and aerial. Paths in the file are
/// relative to it. Refuses a pixel whose colour is no class of the table, saying where, which, and what is nearest.
/// Whether the map fits the planner's limits is for the planner to say.
[[nodiscard]] Result<MapFile> read_map(const std::string& path);

}  // namespace ivo::firmware
