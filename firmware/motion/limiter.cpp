#include "firmware/motion/limiter.hpp"

#include <algorithm>
#include <cmath>

namespace ivo::firmware {
namespace {

double finite_or_zero(double value) noexcept { return std::isfinite(value) ? value : 0.0; }

double step_seconds(Duration dt) noexcept { return std::max(0.0, seconds(dt)); }

// The factor that brings a vector of this length within `limit`.
double scale_to(double limit, double length) noexcept { return length > limit ? limit / length : 1.0; }

}  // namespace

Twist Limiter::limit(const Twist& wanted, Duration dt) noexcept {
  Twist target{finite_or_zero(wanted.vx_mps), finite_or_zero(wanted.vy_mps), finite_or_zero(wanted.wz_radps)};
  const double scale = scale_to(limits_.max_speed_mps, std::hypot(target.vx_mps, target.vy_mps));
  target.vx_mps *= scale;
  target.vy_mps *= scale;
  target.wz_radps = std::clamp(target.wz_radps, -limits_.max_turn_radps, limits_.max_turn_radps);
  const double dt_s = step_seconds(dt);
  return step(target, limits_.max_accel_mps2 * dt_s, limits_.max_turn_accel_radps2 * dt_s);
}

Twist Limiter::ramp_down(Duration dt) noexcept {
  const double dt_s = step_seconds(dt);
  return step({}, limits_.stop_decel_mps2 * dt_s, limits_.max_turn_accel_radps2 * dt_s);
}

Twist Limiter::step(const Twist& target, double translation_mps, double turn_radps) noexcept {
  const double dx = target.vx_mps - current_.vx_mps;
  const double dy = target.vy_mps - current_.vy_mps;
  const double length = std::hypot(dx, dy);
  if (length <= translation_mps) {
    // Assigned, not added: rest is exactly 0, which the doors further down test for.
    current_.vx_mps = target.vx_mps;
    current_.vy_mps = target.vy_mps;
  } else {
    current_.vx_mps += dx / length * translation_mps;
    current_.vy_mps += dy / length * translation_mps;
  }
  const double turn = target.wz_radps - current_.wz_radps;
  if (std::abs(turn) <= turn_radps) {
    current_.wz_radps = target.wz_radps;
  } else {
    current_.wz_radps += std::copysign(turn_radps, turn);
  }
  return current_;
}

}  // namespace ivo::firmware
