// How fast the path ahead may be driven.
#pragma once

#include "config/robot.hpp"
#include "firmware/motion/path_progress.hpp"

namespace ivo::firmware {

/// A robot that turns from one leg into the next keeps its velocity at first; what of it points across the next leg
/// carries it off by (v sin a)^2 / (2 accel) before it is gone. Corners are taken slowly enough that this stays within
/// kCornerError_m, and a polyline that stands for a curve slowly enough for the curve's centripetal acceleration.
class SpeedProfile {
 public:
  static constexpr double kCornerError_m = 0.05;
  /// Along and across the path at once, each is sure of this share of the largest acceleration: the root of one half.
  static constexpr double kAxisShare = 0.7;

  explicit SpeedProfile(const MotionLimits& limits) noexcept;

  /// m/s along the leg that `progress` is on, slow enough for every corner ahead and for the end, where it is 0. Looks
  /// at PathProgress::kLegsPerCycle legs and plans to stop at the end of what it sees.
  [[nodiscard]] double speed_mps(const PathProgress& progress) const noexcept;

  /// m/s from which the robot can stop within `distance_m`; 0 at or below 0.
  [[nodiscard]] double braking_speed_mps(double distance_m) const noexcept;

 private:
  [[nodiscard]] double corner_speed_squared(const Leg& before, const Leg& after) const noexcept;

  double max_speed_squared_;
  double accel_mps2_;
};

}  // namespace ivo::firmware
