#include "firmware/motion/path_progress.hpp"

#include <algorithm>
#include <cmath>

#include "config/base/contract.hpp"

namespace ivo::firmware {
namespace {

constexpr double kShortestLeg_m = 1e-6;

Vector2 vector_of(const Point& p) noexcept { return {p.x_m, p.y_m}; }

double distance_to(const Leg& leg, const Point& p) noexcept {
  const Vector2 offset = vector_of(p) - leg.from;
  const double along = std::clamp(dot(offset, leg.direction), 0.0, leg.length_m);
  return norm(offset - along * leg.direction);
}

}  // namespace

bool PathProgress::start(std::span<const Point> path, const Point& from) noexcept {
  *this = {};
  double length_m = 0.0;
  path_ = path;
  lead_ = from;
  std::size_t last = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double leg_m = leg_at(i).length_m;
    length_m += leg_m;
    last = leg_m > 0 ? i : last;
  }
  if (path.empty() || !std::isfinite(length_m)) {
    *this = {};
    return false;
  }
  last_index_ = last;
  beyond_m_ = length_m;
  enter(0);
  if (last > 0 && distance_to(leg_at(1), from) <= kJoin_m) {
    enter(1);
  }
  update(from);
  return true;
}

bool PathProgress::resume(std::span<const Point> path, const Point& at, double left_m) noexcept {
  if (path.empty() || !std::isfinite(left_m) || !std::isfinite(at.x_m) || !std::isfinite(at.y_m) ||
      !start(path, path.front())) {
    *this = {};
    return false;
  }
  if (left_m > distance_left_m()) {
    return start(path, at);
  }
  while (!on_last_leg() && beyond_m_ >= left_m) {
    enter(index_ + 1);
  }
  passed_m_ = std::clamp(leg_.length_m - (left_m - beyond_m_), 0.0, leg_.length_m);
  update(at);
  return true;
}

void PathProgress::update(const Point& at) noexcept {
  IVO_CONTRACT(has_path());
  for (std::size_t n = 0; n < kLegsPerCycle; ++n) {
    along_m_ = dot(vector_of(at) - leg_.from, leg_.direction);
    passed_m_ = std::max(passed_m_, std::clamp(along_m_, 0.0, leg_.length_m));
    if (on_last_leg() || passed_m_ < leg_.length_m) {
      break;
    }
    enter(index_ + 1);
  }
  cross_track_m_ = cross(leg_.direction, vector_of(at) - leg_.from);
  to_end_m_ = norm(vector_of(vertex(last_index_ + 1)) - vector_of(at));
}

Leg PathProgress::leg_at(std::size_t index) const noexcept {
  Leg leg;
  leg.from = vector_of(vertex(index));
  const Vector2 span = vector_of(vertex(index + 1)) - leg.from;
  const double length_m = norm(span);
  // Written so that a length that is not a number is kept, for start() to see.
  if (!(length_m < kShortestLeg_m)) {
    leg.length_m = length_m;
    leg.direction = span / length_m;
  }
  return leg;
}

void PathProgress::enter(std::size_t index) noexcept {
  // On a leg without a direction the robot goes on as before.
  const Vector2 direction_before = leg_.direction;
  index_ = index;
  leg_ = leg_at(index);
  if (leg_.length_m <= 0) {
    leg_.direction = direction_before;
  }
  beyond_m_ -= leg_.length_m;
  passed_m_ = 0.0;
}

}  // namespace ivo::firmware
