#include "firmware/motion/path_progress.hpp"

#include <algorithm>
#include <cmath>

#include "config/base/contract.hpp"

namespace ivo::firmware {
namespace {

constexpr double kShortestLeg_m = 1e-6;

Eigen::Vector2d vector_of(const Point& p) noexcept { return {p.x_m, p.y_m}; }

double left_of(const Eigen::Vector2d& direction, const Eigen::Vector2d& offset) noexcept {
  return direction.x() * offset.y() - direction.y() * offset.x();
}

double distance_to(const Leg& leg, const Point& p) noexcept {
  const Eigen::Vector2d offset = vector_of(p) - leg.from;
  const double along = std::clamp(offset.dot(leg.direction), 0.0, leg.length_m);
  return (offset - along * leg.direction).norm();
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

void PathProgress::update(const Point& at) noexcept {
  IVO_CONTRACT(has_path());
  for (std::size_t n = 0; n < kLegsPerCycle; ++n) {
    along_m_ = (vector_of(at) - leg_.from).dot(leg_.direction);
    passed_m_ = std::max(passed_m_, std::clamp(along_m_, 0.0, leg_.length_m));
    if (on_last_leg() || passed_m_ < leg_.length_m) {
      break;
    }
    enter(index_ + 1);
  }
  cross_track_m_ = left_of(leg_.direction, vector_of(at) - leg_.from);
  to_end_m_ = (vector_of(vertex(last_index_ + 1)) - vector_of(at)).norm();
}

Leg PathProgress::leg_at(std::size_t index) const noexcept {
  Leg leg;
  leg.from = vector_of(vertex(index));
  const Eigen::Vector2d span = vector_of(vertex(index + 1)) - leg.from;
  const double length_m = span.norm();
  // Written so that a length that is not a number is kept, for start() to see.
  if (!(length_m < kShortestLeg_m)) {
    leg.length_m = length_m;
    leg.direction = span / length_m;
  }
  return leg;
}

void PathProgress::enter(std::size_t index) noexcept {
  // On a leg without a direction the robot goes on as before.
  const Eigen::Vector2d direction_before = leg_.direction;
  index_ = index;
  leg_ = leg_at(index);
  if (leg_.length_m <= 0) {
    leg_.direction = direction_before;
  }
  beyond_m_ -= leg_.length_m;
  passed_m_ = 0.0;
}

}  // namespace ivo::firmware
