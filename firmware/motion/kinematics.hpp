// Wheels and body: what each wheel must turn for a twist, and which twist four turning wheels make.
#pragma once

#include <array>

#include "config/base/geometry.hpp"
#include "config/robot.hpp"

namespace ivo::firmware {

/// One number a wheel, in the order of ivo::Wheel (FL, FR, RL, RR). Positive drives the robot towards +x, in both
/// geometries.
using WheelValues = std::array<double, kWheels>;

/// With r the wheel's radius, R = |(lx, ly)|, and as lever arm of a turn k = turn_scale (lx + ly) or turn_scale R:
///   mecanum: r w = vx -/+ vy -/+ k wz              FL (-,-)  FR (+,+)  RL (+,-)  RR (-,+)
///   omni X:  r w = (ly vx -/+ lx vy) / R -/+ k wz, the same signs; its axles lie along the diagonals of the base.
/// Both follow from no slip along the wheel's driven direction at its point of contact. Rollers touch the floor over
/// their width, so the k of a turn is a matter of calibration: turn on the spot by odometry, and multiply turn_scale by
/// the turn that odometry told over the turn that was made.
class Kinematics {
 public:
  /// Radius, half length, half width, turn scale and largest wheel speed must be finite and above 0 (contract: the
  /// robot file's reader refuses others).
  explicit Kinematics(const BaseParameters& base) noexcept;

  /// rad/s.
  [[nodiscard]] WheelValues wheel_speeds(const Twist& twist) const noexcept;

  /// The twist that fits the four speeds (rad/s) best in least squares. Linear: wheel angles in rad give metres and
  /// radians.
  [[nodiscard]] Twist twist(const WheelValues& speeds_radps) const noexcept;

  /// The part of the speeds (rad/s) that no twist explains, at the rim in m/s: r (FL + FR - RL - RR) / 2, the unit
  /// left-null vector of both geometries. 0 without slip; noise of one sigma at every wheel gives r sigma here.
  [[nodiscard]] double slip_residual_mps(const WheelValues& speeds_radps) const noexcept;

  /// The factor, 0 to 1, for the whole twist that made these speeds (rad/s), so that no wheel exceeds its largest speed
  /// and the direction is kept. 0 when a speed is not finite.
  [[nodiscard]] double saturation(const WheelValues& speeds_radps) const noexcept;

 private:
  double wheel_radius_m_;
  double max_wheel_radps_;
  // Matrices, column by column: 4 x 3 and 3 x 4. Eigen is the source's own, since it costs whoever includes it seconds.
  std::array<double, 3 * kWheels> wheels_from_twist_{};
  std::array<double, 3 * kWheels> twist_from_wheels_{};
};

}  // namespace ivo::firmware
