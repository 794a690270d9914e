#include "firmware/motion/arc.hpp"

#include <cmath>
#include <numbers>

namespace ivo::firmware {
namespace {

// Below this the next term of the series, x^4 / 120, is under the last bit of a double; the quotient would divide by
// zero.
constexpr double kSmallAngle_rad = 1e-4;

double sine_over(double x) noexcept { return std::abs(x) < kSmallAngle_rad ? 1.0 - x * x / 6.0 : std::sin(x) / x; }

}  // namespace

Pose advance(const Pose& from, const Twist& twist, double dt_s) noexcept {
  // The chord of an arc of angle t points t/2 away from its first tangent and is sin(t/2)/(t/2) of its length.
  const double half_turn_rad = 0.5 * twist.wz_radps * dt_s;
  const double chord_s = sine_over(half_turn_rad) * dt_s;
  const double c = std::cos(from.heading_rad + half_turn_rad);
  const double s = std::sin(from.heading_rad + half_turn_rad);
  return {from.x_m + chord_s * (c * twist.vx_mps - s * twist.vy_mps),
          from.y_m + chord_s * (s * twist.vx_mps + c * twist.vy_mps),
          std::remainder(from.heading_rad + 2.0 * half_turn_rad, 2.0 * std::numbers::pi)};
}

}  // namespace ivo::firmware
