// Where the object may still be: the prior without what the agents have looked at.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "config/base/geometry.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware {

/// Outside the loop. The cells are its own: a planner is prepared anew when people want another plan.
class BeliefLeft {
 public:
  explicit BeliefLeft(const planner::Planner& planner);

  /// An agent is at `place`: what it sees from there is searched. Cost: its sight disc.
  void look(Point place, double sight_radius_m);
  /// An agent has gone the first `moved_m` of a path: what it saw on its way is searched.
  void look_along(std::span<const Point> waypoints, double moved_m, double sight_radius_m);
  /// Of each cell, as Cells numbers them.
  [[nodiscard]] std::span<const float> mass() const noexcept { return mass_; }
  [[nodiscard]] const planner::Cells& cells() const noexcept { return *cells_; }

 private:
  std::unique_ptr<const planner::Cells> cells_;
  std::vector<float> mass_;
};

}  // namespace ivo::firmware
