// A map as map_server of ROS 1 and Nav2 keep it: map.yaml and a grey image.
#pragma once

#include <string>

#include "config/base/result.hpp"
#include "firmware/files/map_file.hpp"

namespace ivo::firmware {

/// Keys: image (PGM or PNG, relative to the file), resolution, origin [x, y, yaw], negate, occupied_thresh,
/// free_thresh, optional mode: trinary, scale or raw. Free pixels are pavement, occupied ones wall, and unknown ones
/// building: where nobody has been the robot does not go, nor look through. What `scale` has between its thresholds is
/// unknown, too.
///
/// Our frame begins at the image's lower-left corner: MapFile::origin_m is where ROS has it. A map that is turned (yaw
/// other than 0) is refused, and so is an image with transparent pixels.
[[nodiscard]] Result<MapFile> read_ros_map(const std::string& path);

}  // namespace ivo::firmware
