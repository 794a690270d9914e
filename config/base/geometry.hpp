// Plane geometry of the map frame: x right, y up, metres, origin at the lower-left corner of the map; angles in
// radians, counter-clockwise (model.md, "World"; as ROS map_server has it). The body frame is REP-103: x forward, y
// left.
#pragma once

namespace ivo {

struct Point {
  double x_m = 0.0;
  double y_m = 0.0;
  friend bool operator==(const Point&, const Point&) = default;
};

struct Pose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  [[nodiscard]] constexpr Point point() const noexcept { return {x_m, y_m}; }
};

/// Velocity in the body frame.
struct Twist {
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  double wz_radps = 0.0;
};

}  // namespace ivo
