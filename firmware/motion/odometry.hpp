// Where the robot is, from how far its wheels have turned.
#pragma once

#include <optional>

#include "config/base/geometry.hpp"
#include "firmware/motion/kinematics.hpp"

namespace ivo::firmware {

/// Dead reckoning from wheel angles: the least-squares body motion between two readings, laid along its exact arc.
/// Angles are differenced, so a cycle without a reading loses nothing but the bend within the gap.
class Odometry {
 public:
  explicit Odometry(const Kinematics& kinematics) noexcept : kinematics_(kinematics) {}

  /// The robot is at `pose` now; the next reading of the wheels becomes the reference.
  void reset(const Pose& pose) noexcept;

  /// Takes the wheels' unwrapped angles (rad, since any fixed origin). False, with the pose kept, when one is not
  /// finite.
  bool update(const WheelValues& angles_rad) noexcept;

  /// What the last update() laid to the pose, as a twist held for one second (m, m, rad in the body frame): 0 when it
  /// was the first or was refused. For PoseFilter::predict.
  [[nodiscard]] const Twist& moved() const noexcept { return moved_; }

  /// In the frame of the pose given to reset(); the heading within [-pi, pi].
  [[nodiscard]] const Pose& pose() const noexcept { return pose_; }

 private:
  Kinematics kinematics_;
  Pose pose_;
  Twist moved_;
  std::optional<WheelValues> reference_rad_;
};

}  // namespace ivo::firmware
