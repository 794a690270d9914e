// Messages of ROS as a session takes them in: strict, in the form of ROS 1 or of ROS 2. What is wrong is kept by the
// reading, "TOPIC: FIELD: what was wrong; what is expected".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/time.hpp"
#include "config/mission.hpp"
#include "firmware/files/json_reading.hpp"
#include "firmware/files/json_value.hpp"

namespace ivo::firmware::web {

/// Which frame the points of a message are in.
enum class PointFrame : std::uint8_t { kMap, kRobot };

/// "map" or none.
void expect_map_frame(JsonReading& reading, const Json& message);
/// "map", or the robot's: base_link, base_footprint, or a laser's, which is taken to sit at the robot's centre.
[[nodiscard]] PointFrame point_frame(JsonReading& reading, const Json& message, bool may_be_map);

/// How old the message is, by its stamp, 0 to 10 s. Without a stamp, with one of 0 or from the future, 0; older is a
/// fault. `since_epoch`: the time now.
[[nodiscard]] double age_s(JsonReading& reading, const Json& message, Duration since_epoch);

/// x, y and the turn about z of a geometry_msgs/Pose. `must_turn`: an orientation of zeros is a fault, else no turn.
[[nodiscard]] Pose pose_of(JsonReading& reading, const Json& pose, const std::string& at, bool must_turn);

struct UncertainPose {
  Pose pose;
  double sigma_m = 0.0;
  double sigma_heading_rad = 0.0;
};
/// geometry_msgs/PoseWithCovariance.
[[nodiscard]] UncertainPose uncertain_pose_of(JsonReading& reading, const Json& pose);

/// geometry_msgs/PolygonStamped: a simple polygon; a last corner as the first is left out.
[[nodiscard]] Polygon polygon_of(JsonReading& reading, const Json& message);

/// sensor_msgs/LaserScan, in the scanner's frame; ranges that are no number or out of range are passed over.
[[nodiscard]] std::vector<Point> scan_points(JsonReading& reading, const Json& message);

/// sensor_msgs/PointCloud2 with x and y as float32; points that are no numbers are passed over. data: base64, or a
/// list.
[[nodiscard]] std::vector<Point> cloud_points(JsonReading& reading, const Json& message);

/// geometry_msgs/PoseArray.
[[nodiscard]] std::vector<Point> people_points(JsonReading& reading, const Json& message);

}  // namespace ivo::firmware::web
