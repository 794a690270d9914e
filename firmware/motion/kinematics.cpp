#include "firmware/motion/kinematics.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "config/base/contract.hpp"

namespace ivo::firmware {
namespace {

using WheelMatrix = Eigen::Matrix<double, kWheels, 3>;
using TwistMatrix = Eigen::Matrix<double, 3, kWheels>;
using WheelVector = Eigen::Matrix<double, kWheels, 1>;

bool positive(double value) noexcept { return std::isfinite(value) && value > 0; }

WheelMatrix rim_speeds_from_twist(const BaseParameters& base) noexcept {
  WheelMatrix signs;
  signs << 1, -1, -1,  //
      1, 1, 1,         //
      1, 1, -1,        //
      1, -1, 1;
  const double lx = base.half_length_m;
  const double ly = base.half_width_m;
  const double diagonal = std::hypot(lx, ly);
  const Eigen::Vector3d lever = base.geometry == WheelGeometry::kMecanum
                                    ? Eigen::Vector3d(1.0, 1.0, base.turn_scale * (lx + ly))
                                    : Eigen::Vector3d(ly / diagonal, lx / diagonal, base.turn_scale * diagonal);
  return signs * lever.asDiagonal();
}

}  // namespace

Kinematics::Kinematics(const BaseParameters& base) noexcept
    : wheel_radius_m_(base.wheel_radius_m), max_wheel_radps_(base.max_wheel_radps) {
  IVO_CONTRACT(positive(base.wheel_radius_m) && positive(base.half_length_m) && positive(base.half_width_m) &&
               positive(base.max_wheel_radps) && positive(base.turn_scale));
  const WheelMatrix wheels_from_twist = rim_speeds_from_twist(base) / wheel_radius_m_;
  const Eigen::Matrix3d normal = wheels_from_twist.transpose() * wheels_from_twist;
  Eigen::Map<WheelMatrix>(wheels_from_twist_.data()) = wheels_from_twist;
  Eigen::Map<TwistMatrix>(twist_from_wheels_.data()) = normal.inverse() * wheels_from_twist.transpose();
}

WheelValues Kinematics::wheel_speeds(const Twist& twist) const noexcept {
  const WheelVector w = Eigen::Map<const WheelMatrix>(wheels_from_twist_.data()) *
                        Eigen::Vector3d(twist.vx_mps, twist.vy_mps, twist.wz_radps);
  return {w[0], w[1], w[2], w[3]};
}

Twist Kinematics::twist(const WheelValues& speeds_radps) const noexcept {
  const Eigen::Vector3d t =
      Eigen::Map<const TwistMatrix>(twist_from_wheels_.data()) * Eigen::Map<const WheelVector>(speeds_radps.data());
  return {t[0], t[1], t[2]};
}

double Kinematics::slip_residual_mps(const WheelValues& speeds_radps) const noexcept {
  const auto& [fl, fr, rl, rr] = speeds_radps;
  return wheel_radius_m_ * (fl + fr - rl - rr) / 2.0;
}

double Kinematics::saturation(const WheelValues& speeds_radps) const noexcept {
  double scale = 1.0;
  for (const double speed : speeds_radps) {
    if (!std::isfinite(speed)) {
      return 0.0;
    }
    if (std::abs(speed) > max_wheel_radps_) {
      scale = std::min(scale, max_wheel_radps_ / std::abs(speed));
    }
  }
  return scale;
}

}  // namespace ivo::firmware
