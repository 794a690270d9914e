#include "firmware/motion/speed_profile.hpp"

#include <algorithm>
#include <cmath>

namespace ivo::firmware {
namespace {

// A robot this slow is never carried off further than this, whatever the corner, so nothing asks for less.
constexpr double kCrawlError_m = 0.005;

// Two legs that bend less than this are one line to any accuracy the base has.
constexpr double kStraight = 1e-9;

}  // namespace

SpeedProfile::SpeedProfile(const MotionLimits& limits) noexcept
    : max_speed_squared_(limits.max_speed_mps * limits.max_speed_mps),
      accel_mps2_(kAxisShare * limits.max_accel_mps2) {}

double SpeedProfile::speed_mps(const PathProgress& progress) const noexcept {
  double squared = max_speed_squared_;
  double ahead_m = progress.leg_left_m();
  Leg before = progress.leg();
  std::size_t index = progress.leg_index();
  for (std::size_t n = 0; n < PathProgress::kLegsPerCycle && index < progress.last_leg_index(); ++n) {
    const double braking_squared = 2.0 * accel_mps2_ * ahead_m;
    if (braking_squared >= max_speed_squared_) {
      break;
    }
    const Leg after = progress.leg_at(++index);
    if (after.length_m > 0) {
      squared = std::min(squared, corner_speed_squared(before, after) + braking_squared);
      ahead_m += after.length_m;
      before = after;
    }
  }
  return std::min(std::sqrt(squared), braking_speed_mps(ahead_m));
}

double SpeedProfile::braking_speed_mps(double distance_m) const noexcept {
  return std::sqrt(std::min(max_speed_squared_, 2.0 * accel_mps2_ * std::max(0.0, distance_m)));
}

double SpeedProfile::corner_speed_squared(const Leg& before, const Leg& after) const noexcept {
  const double bend = norm(after.direction - before.direction);
  if (bend < kStraight) {
    return max_speed_squared_;
  }
  const double sine = cross(before.direction, after.direction);
  // From 90 degrees on, the velocity also points back along the next leg: all of it is to be lost.
  const double across = dot(before.direction, after.direction) > 0 ? sine * sine : 1.0;
  const double corner = 2.0 * accel_mps2_ * kCornerError_m / across;
  const double curve = accel_mps2_ * std::min(before.length_m, after.length_m) / bend;
  return std::max(std::min(corner, curve), 2.0 * accel_mps2_ * kCrawlError_m);
}

}  // namespace ivo::firmware
