#include "firmware/mission/simulated_person.hpp"

#include <cmath>

namespace ivo::firmware {

void SimulatedPerson::start(const planner::AgentPath& path, double speed_mps) noexcept {
  path_ = &path;
  speed_mps_ = speed_mps;
  next_ = 1;
  position_ = path.waypoints[0];
  walked_m_ = 0.0;
}

void SimulatedPerson::resume(const planner::AgentPath& path, double speed_mps, double walked_m) noexcept {
  start(path, speed_mps);
  go(walked_m);
}

void SimulatedPerson::follow(const planner::AgentPath& path) noexcept {
  path_ = &path;
  next_ = 0;
  walked_m_ = 0.0;
}

void SimulatedPerson::walk(Duration dt) noexcept { go(speed_mps_ * seconds(dt)); }

void SimulatedPerson::go(double left_m) noexcept {
  while (!arrived() && left_m > 0.0) {
    const Point ahead = path_->waypoints[next_];
    const double dx = ahead.x_m - position_.x_m;
    const double dy = ahead.y_m - position_.y_m;
    const double distance_m = std::sqrt(dx * dx + dy * dy);
    if (distance_m <= left_m) {
      position_ = ahead;
      walked_m_ += distance_m;
      left_m -= distance_m;
      ++next_;
      continue;
    }
    position_.x_m += dx / distance_m * left_m;
    position_.y_m += dy / distance_m * left_m;
    walked_m_ += left_m;
    left_m = 0.0;
  }
}

}  // namespace ivo::firmware
