// What any waypoints are worth, exactly: no graph, no table, so that plans of other tools and waypoints off the graph
// are judged by the same rule as the planner's own (Eq. 5, 8 and 10; model.md, "Sensing and expected time").
#pragma once

#include <array>
#include <span>

#include "config/base/geometry.hpp"
#include "config/limits.hpp"
#include "planner/search/belief.hpp"
#include "planner/search/expected_time.hpp"
#include "planner/search/first_sightings.hpp"
#include "planner/search/plan.hpp"
#include "planner/world/cells.hpp"

namespace ivo::planner {

/// One agent's way: straight from waypoint to waypoint at one speed.
struct WaypointPath {
  std::span<const Point> waypoints;  ///< on the map; the first is where the agent is at time 0
  double speed_mps = 0.5;            ///< v_m, above 0
  double sight_radius_m = 2.5;       ///< R_m
};

/// Metres along `waypoints`. Cost: a square root a waypoint.
[[nodiscard]] double length_m(std::span<const Point> waypoints) noexcept;

/// Large: its scratch is a sighting for each cell of the build's capacity.
class PathScorer {
 public:
  /// One path an agent, in the agents' order; what a path does after it last saw something new costs nothing. Who may
  /// go where is not asked. `max_unseen_mass` decides what is complete. Cost: sight points times the disc, each of its
  /// cells with a line of sight where something occludes.
  PlanScore score(const Cells& cells, const Belief& belief, std::span<const WaypointPath> paths,
                  double max_unseen_mass) noexcept;

  /// Of the last score: when the agent's path ends, where it last sees something new; 0 when it never does.
  [[nodiscard]] double path_end_s(int agent) const noexcept { return expected_.path_end_s(agent); }

 private:
  void look(const Cells& cells, const Belief& belief, int agent, double radius_m, Point from, double time_s) noexcept;
  void look_along(const Cells& cells, const Belief& belief, int agent, const WaypointPath& path) noexcept;

  FirstSightings sightings_;
  ExpectedTime expected_;
};

}  // namespace ivo::planner
