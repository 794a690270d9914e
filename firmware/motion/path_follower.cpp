#include "firmware/motion/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/motion/finite.hpp"

namespace ivo::firmware {
namespace {

constexpr double kGain_per_s = 1.5;    // of the return to the path and to the heading
constexpr double kAcrossShare = 0.5;   // of the largest speed, for the return to the path
constexpr double kWaitError_m = 0.10;  // from here on the robot does not go on along the path
constexpr double kSlow_mps = 0.10;     // stops within a centimetre at the default deceleration

Vector2 turned(const Vector2& v, double cosine, double sine) noexcept {
  return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y};
}

// Towards 0 from `error`, at no more than `limit` and no faster than `accel` can stop at 0.
double returning(double error, double limit, double accel) noexcept {
  const double rate = std::min({kGain_per_s * std::abs(error), std::sqrt(accel * std::abs(error)), limit});
  return -std::copysign(rate, error);
}

}  // namespace

bool PathFollower::start(std::span<const Point> path, const Pose& pose) noexcept {
  reached_ = false;
  heading_rad_ = pose.heading_rad;
  return progress_.start(finite(pose) ? path : std::span<const Point>{}, pose.point());
}

bool PathFollower::resume(std::span<const Point> path, const Pose& pose, double heading_rad, double left_m) noexcept {
  reached_ = false;
  heading_rad_ = heading_rad;
  const bool known = finite(pose) && std::isfinite(heading_rad);
  return progress_.resume(known ? path : std::span<const Point>{}, pose.point(), left_m);
}

PathFollower::Output PathFollower::update(const Input& input) noexcept {
  if (!progress_.has_path()) {
    return {};
  }
  if (!finite(input.pose)) {
    return {{}, progress_.distance_left_m(), progress_.cross_track_m(), reached_};
  }
  progress_.update(input.pose.point());
  Input known = input;
  if (!finite(known.moving)) {
    known.moving = {};
  }
  const double speed_mps = std::hypot(known.moving.vx_mps, known.moving.vy_mps);
  reached_ = reached_ || (progress_.on_last_leg() && progress_.to_end_m() <= kEndTolerance_m && speed_mps <= kSlow_mps);
  return {command(known), progress_.distance_left_m(), progress_.cross_track_m(), reached_};
}

Twist PathFollower::command(const Input& input) const noexcept {
  const double dt_s = std::max(0.0, seconds(input.dt));
  // The angle from the body to the path.
  const Vector2 path =
      turned(progress_.leg().direction, std::cos(input.pose.heading_rad), -std::sin(input.pose.heading_rad));
  const Vector2 moving = turned({input.moving.vx_mps, input.moving.vy_mps}, path.x, -path.y);

  const Vector2 wanted = reached_ ? Vector2{} : Vector2{along_mps(), across_mps()};
  const double step_mps = limits_.max_accel_mps2 * dt_s;
  // Each axis is cut before the vector is: a long way to go along the path must not starve the return to it.
  const Vector2 missing = wanted - moving;
  Vector2 step{std::clamp(missing.x, -step_mps, step_mps), std::clamp(missing.y, -step_mps, step_mps)};
  if (norm(step) > step_mps) {
    step = step_mps / norm(step) * step;
  }
  Vector2 next = moving + step;
  if (norm(next) > limits_.max_speed_mps) {
    next = limits_.max_speed_mps / norm(next) * next;
  }
  const Vector2 velocity = turned(next, path.x, path.y);
  return {velocity.x, velocity.y, turn_radps(input)};
}

double PathFollower::along_mps() const noexcept {
  const double on_path = std::max(0.0, 1.0 - std::abs(progress_.cross_track_m()) / kWaitError_m);
  if (progress_.on_last_leg()) {
    // Signed, so that a robot carried past the end comes back.
    const double left_m = progress_.along_left_m();
    return std::copysign(profile_.braking_speed_mps(std::abs(left_m)), left_m) * on_path;
  }
  return profile_.speed_mps(progress_) * on_path;
}

double PathFollower::across_mps() const noexcept {
  return returning(progress_.cross_track_m(), kAcrossShare * limits_.max_speed_mps, limits_.max_accel_mps2);
}

double PathFollower::turn_radps(const Input& input) const noexcept {
  const double error_rad = std::remainder(input.pose.heading_rad - heading_rad_, 2.0 * std::numbers::pi);
  const double wanted = returning(error_rad, limits_.max_turn_radps, limits_.max_turn_accel_radps2);
  const double step = limits_.max_turn_accel_radps2 * std::max(0.0, seconds(input.dt));
  return input.moving.wz_radps + std::clamp(wanted - input.moving.wz_radps, -step, step);
}

}  // namespace ivo::firmware
