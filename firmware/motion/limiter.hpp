// Bounds how fast the robot goes and how fast that changes.
#pragma once

#include "config/base/geometry.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::firmware {

/// Remembers the last twist it gave and gives the next one nearest to what is wanted. Translation is limited as a
/// vector, so its direction is kept; the turn apart. Scale a twist by Kinematics::saturation before it comes here:
/// every twist on the way from one that the wheels can do to another is one that they can do.
class Limiter {
 public:
  explicit Limiter(const MotionLimits& limits) noexcept : limits_(limits) {}

  /// One step of `dt` towards `wanted`, cut to the largest speed and turn, at no more than the planned acceleration.
  /// What is not finite counts as 0, and a `dt` below 0 as 0.
  Twist limit(const Twist& wanted, Duration dt) noexcept;

  /// One step of `dt` towards rest, the translation at the deceleration of an unplanned stop, the turn at its largest
  /// acceleration.
  Twist ramp_down(Duration dt) noexcept;

  /// The robot is known to move at `twist`, at rest by default: what limit() goes on from.
  void reset(const Twist& twist = {}) noexcept { current_ = twist; }

  /// The last twist given.
  [[nodiscard]] const Twist& current() const noexcept { return current_; }

 private:
  Twist step(const Twist& target, double translation_mps, double turn_radps) noexcept;

  MotionLimits limits_;
  Twist current_;
};

}  // namespace ivo::firmware
