// A person who walks the plan: along its waypoints at the planned speed, then stands.
#pragma once

#include "config/base/time.hpp"
#include "planner/search/plan.hpp"

namespace ivo::firmware {

class SimulatedPerson {
 public:
  /// `path` outlives the walk.
  void start(const planner::AgentPath& path, double speed_mps) noexcept;

  /// Has come `walked_m` along it.
  void resume(const planner::AgentPath& path, double speed_mps, double walked_m) noexcept;

  /// From where they are, to the beginning of `path` and along it; walked_m() begins anew.
  void follow(const planner::AgentPath& path) noexcept;

  /// Cost: the waypoints passed in `dt`.
  void walk(Duration dt) noexcept;

  [[nodiscard]] Point position() const noexcept { return position_; }
  [[nodiscard]] double walked_m() const noexcept { return walked_m_; }
  [[nodiscard]] bool arrived() const noexcept { return next_ >= path_->waypoints.size(); }

 private:
  void go(double left_m) noexcept;

  const planner::AgentPath* path_ = nullptr;
  double speed_mps_ = 0.0;
  std::size_t next_ = 0;  // waypoint ahead
  Point position_;
  double walked_m_ = 0.0;
};

}  // namespace ivo::firmware
