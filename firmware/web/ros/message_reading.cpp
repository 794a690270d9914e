#include "firmware/web/ros/message_reading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "config/limits.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/polygon_checks.hpp"

namespace ivo::firmware::web {
namespace {

constexpr double kFar_m = 1e6;
constexpr std::size_t kMostPeople = 1000;
constexpr std::array<std::string_view, 7> kRobotFrames = {"base_link",  "base_footprint", "laser",    "laser_frame",
                                                          "laser_link", "base_laser",     "base_scan"};

/// Without its leading slash, which ROS 1 has now and then; empty when there is no header.
std::string frame_of(JsonReading& reading, const Json& message) {
  const Json* const header = message.member("header");
  if (header == nullptr || header->member("frame_id") == nullptr) {
    return {};
  }
  const std::string frame = reading.text(*header, "header.", "frame_id");
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

/// Either name, the one of ROS 2 or of ROS 1; 0 when neither is there.
double time_part(JsonReading& reading, const Json& stamp, const char* ros2, const char* ros1, double most) {
  const char* const key = stamp.member(ros2) != nullptr ? ros2 : ros1;
  return stamp.member(key) == nullptr ? 0.0 : reading.number(stamp, "header.stamp.", key, 0.0, most);
}

Point plane_point(JsonReading& reading, const Json& object, const std::string& at) {
  return {reading.number(object, at, "x", -kFar_m, kFar_m), reading.number(object, at, "y", -kFar_m, kFar_m)};
}

double turn_of(JsonReading& reading, const Json& orientation, const std::string& at, bool must_turn) {
  std::array<double, 4> q{};
  constexpr std::array<const char*, 4> kNames = {"x", "y", "z", "w"};
  double square = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    q[i] = reading.number(orientation, at, kNames[i], -1.01, 1.01);
    square += q[i] * q[i];
  }
  if (square == 0.0 && !must_turn) {
    return 0.0;
  }
  if (reading.ok() && std::abs(square - 1.0) > 0.02) {
    reading.fault(at + "w", "belongs to a quaternion of length " + shortest(std::sqrt(square)) + "; expected length 1");
  }
  const auto [x, y, z, w] = q;
  return std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

double sigma_of(JsonReading& reading, const Json& list, std::size_t i) {
  return std::sqrt(reading.number(&list.elements[i], element("covariance", i), 0.0, 1e12));
}

}  // namespace

void expect_map_frame(JsonReading& reading, const Json& message) {
  const std::string frame = frame_of(reading, message);
  if (!frame.empty() && frame != "map") {
    reading.fault("header.frame_id", shown_text(frame) + " is another frame; expected \"map\"");
  }
}

PointFrame point_frame(JsonReading& reading, const Json& message, bool may_be_map) {
  const std::string frame = frame_of(reading, message);
  if (may_be_map && frame == "map") {
    return PointFrame::kMap;
  }
  if (!frame.empty() && std::find(kRobotFrames.begin(), kRobotFrames.end(), frame) == kRobotFrames.end()) {
    std::string all = may_be_map ? "map" : "";
    for (const std::string_view name : kRobotFrames) {
      all.append(all.empty() ? "" : ", ").append(name);
    }
    reading.fault("header.frame_id", shown_text(frame) + " is another frame; expected one of " + all);
  }
  return PointFrame::kRobot;
}

double age_s(JsonReading& reading, const Json& message, Duration since_epoch) {
  constexpr double kOldest_s = 10.0;
  const Json* const header = message.member("header");
  const Json* const stamp = header == nullptr ? nullptr : header->member("stamp");
  if (stamp == nullptr) {
    return 0.0;
  }
  const double whole_s = time_part(reading, *stamp, "sec", "secs", 1e11);
  const double rest_s = time_part(reading, *stamp, "nanosec", "nsecs", 1e9) / 1e9;
  const double age = whole_s + rest_s == 0.0 ? 0.0 : seconds(since_epoch) - whole_s - rest_s;
  if (age > kOldest_s) {
    reading.fault("header.stamp",
                  "is " + shortest(std::round(age)) + " s old; expected at most 10, or clocks that agree");
  }
  return std::max(age, 0.0);
}

Pose pose_of(JsonReading& reading, const Json& pose, const std::string& at, bool must_turn) {
  const Json* const position = reading.field(pose, at, "position");
  if (position == nullptr) {
    return {};
  }
  const Point place = plane_point(reading, *position, at + "position.");
  const Json* const orientation = must_turn ? reading.field(pose, at, "orientation") : pose.member("orientation");
  const double heading_rad =
      orientation == nullptr ? 0.0 : turn_of(reading, *orientation, at + "orientation.", must_turn);
  return {place.x_m, place.y_m, heading_rad};
}

UncertainPose uncertain_pose_of(JsonReading& reading, const Json& pose) {
  // Row by row of x, y, z and the turns about them.
  constexpr std::size_t kEntries = 36;
  constexpr std::size_t kX = 0;
  constexpr std::size_t kY = 7;
  constexpr std::size_t kTurn = 35;
  UncertainPose read;
  const Json* const inner = reading.field(pose, "pose.", "pose");
  const Json& covariance = reading.list(pose, "pose.", "covariance");
  if (inner == nullptr || covariance.elements.size() != kEntries) {
    reading.fault("pose.covariance", "has " + std::to_string(covariance.elements.size()) + " entries; expected 36");
    return read;
  }
  read.pose = pose_of(reading, *inner, "pose.pose.", true);
  read.sigma_m = std::max(sigma_of(reading, covariance, kX), sigma_of(reading, covariance, kY));
  read.sigma_heading_rad = std::min(sigma_of(reading, covariance, kTurn), std::numbers::pi);
  return read;
}

Polygon polygon_of(JsonReading& reading, const Json& message) {
  Polygon polygon;
  const Json* const inner = reading.field(message, "", "polygon");
  if (inner == nullptr) {
    return polygon;
  }
  const Json& points = reading.list(*inner, "polygon.", "points");
  constexpr std::size_t kMost = limits::kPolygonVertices;
  for (std::size_t i = 0; i < points.elements.size() && i < kMost + 2; ++i) {
    polygon.push_back(plane_point(reading, points.elements[i], element("polygon.points", i) + "."));
  }
  if (polygon.size() > 3 && polygon.front() == polygon.back()) {
    polygon.pop_back();
  }
  if (polygon.size() < 3 || polygon.size() > kMost) {
    reading.fault("polygon.points",
                  "has " + std::to_string(points.elements.size()) + " points; expected 3 to " + std::to_string(kMost));
  } else if (const std::optional<std::string> fault = fault_of(polygon); reading.ok() && fault) {
    reading.fault("polygon.points", *fault);
  }
  return polygon;
}

std::vector<Point> scan_points(JsonReading& reading, const Json& message) {
  std::vector<Point> points;
  const double first_rad = reading.number(message, "", "angle_min", -100.0, 100.0);
  const double step_rad = reading.number(message, "", "angle_increment", -10.0, 10.0);
  const double least_m = reading.number(message, "", "range_min", 0.0, kFar_m);
  const double most_m = reading.number(message, "", "range_max", 0.0, kFar_m);
  const Json* const ranges = reading.field(message, "", "ranges");
  if (ranges == nullptr || ranges->kind != Json::Kind::kList) {
    reading.fault("ranges", "is no list; expected the ranges");
    return points;
  }
  for (std::size_t i = 0; i < ranges->elements.size(); ++i) {
    const Json& range = ranges->elements[i];
    if (!range.is_number() && range.kind != Json::Kind::kNull) {
      reading.fault(element("ranges", i), "is no number; expected a number, or null where nothing was seen");
    } else if (range.is_number() && range.real >= least_m && range.real <= most_m) {
      const double angle_rad = first_rad + step_rad * static_cast<double>(i);
      points.push_back({range.real * std::cos(angle_rad), range.real * std::sin(angle_rad)});
    }
  }
  return points;
}

std::vector<Point> people_points(JsonReading& reading, const Json& message) {
  std::vector<Point> points;
  const Json* const poses = reading.field(message, "", "poses");
  if (poses == nullptr || poses->kind != Json::Kind::kList || poses->elements.size() > kMostPeople) {
    reading.fault("poses", "is no list of at most 1000; expected the people's poses");
    return points;
  }
  for (std::size_t i = 0; i < poses->elements.size(); ++i) {
    points.push_back(pose_of(reading, poses->elements[i], element("poses", i) + ".", false).point());
  }
  return points;
}

}  // namespace ivo::firmware::web
