// Messages of ROS that several topics are made of, written in the form of ROS 1 or of ROS 2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/time.hpp"
#include "firmware/web/ros/value_writer.hpp"

namespace ivo::firmware::web {

struct RosStamp {
  Duration since_epoch{};
  bool ros2 = true;            ///< sec and nanosec; of ROS 1 secs and nsecs, and a header has a seq
  std::uint32_t sequence = 0;  ///< of ROS 1
};

/// A grid's place in the frame of ROS.
struct GridPlace {
  int columns = 0;
  int rows = 0;
  double side_m = 0.0;  ///< of a cell
  Point origin_m;       ///< of its lower-left corner
};

void write_time(ValueWriter& writer, std::string_view key, const RosStamp& stamp);
void write_header(ValueWriter& writer, const RosStamp& stamp, std::string_view frame = "map");
/// A member "pose": turned about z alone.
void write_pose(ValueWriter& writer, std::string_view key, const Pose& pose);
/// A member of x, y and z.
void write_vector(ValueWriter& writer, std::string_view key, double x, double y, double z);

/// nav_msgs/OccupancyGrid; row by row, the bottom row first, 0 to 100.
void write_grid(ValueWriter& writer, const RosStamp& stamp, const GridPlace& place,
                const std::vector<std::int8_t>& values);
/// nav_msgs/Path; each pose looks to the next, the last as the one before it.
void write_path(ValueWriter& writer, const RosStamp& stamp, const std::vector<Point>& waypoints);
/// std_msgs/Float32MultiArray of rows and columns, the bottom row first.
void write_floats(ValueWriter& writer, const GridPlace& place, const std::vector<float>& values);

}  // namespace ivo::firmware::web
