// What any waypoints are worth, exactly: no graph, no table, so that plans of other tools and waypoints off the graph
// are judged by the same rule as the planner's own (Eq. 5, 8 and 10; model.md, "Sensing and expected time").
#pragma once

#include <array>
#include <span>

#include "config/base/geometry.hpp"
#include "config/base/static_vector.hpp"
#include "config/limits.hpp"
#include "planner/search/belief.hpp"
#include "planner/search/expected_time.hpp"
#include "planner/search/first_sightings.hpp"
#include "planner/search/plan.hpp"
#include "planner/world/cells.hpp"
#include "planner/world/seen_map.hpp"

namespace ivo::planner {

/// One agent's way: straight from waypoint to waypoint at one speed.
struct WaypointPath {
  std::span<const Point> waypoints;  ///< on the map; the first is where the agent is at time 0
  double speed_mps = 0.5;            ///< v_m, above 0
  double sight_radius_m = 2.5;       ///< R_m
};

/// Metres along `waypoints`. Cost: a square root a waypoint.
[[nodiscard]] double length_m(std::span<const Point> waypoints) noexcept;

class PathScorer {
 public:
  /// `sightings` is its scratch.
  explicit PathScorer(FirstSightings& sightings) noexcept : sightings_(sightings) {}

  /// One path an agent, in the agents' order; what a path does after it last saw something new costs nothing. Who may
  /// go where is not asked. `max_unseen_mass` decides what is complete. Cost: sight points times the disc's rows, and a
  /// line of sight for each new cell where something occludes.
  PlanScore score(const Cells& cells, const Belief& belief, std::span<const WaypointPath> paths,
                  double max_unseen_mass) noexcept;

  /// The same in parts. What the arguments refer to lasts until done().
  void start(const Cells& cells, const Belief& belief, std::span<const WaypointPath> paths,
             double max_unseen_mass) noexcept;
  /// Up to about `rows` rows of discs and cells of the sum. Returns the work done.
  int advance(int rows) noexcept;
  [[nodiscard]] bool done() const noexcept { return phase_ == Phase::kDone; }
  /// When done.
  [[nodiscard]] PlanScore score() const noexcept;

  /// Of the last score: when the agent's path ends, where it last sees something new; 0 when it never does.
  [[nodiscard]] double path_end_s(int agent) const noexcept { return to_double(expected_.path_end_s(agent)); }

 private:
  enum class Phase : std::uint8_t { kClear, kLook, kSum, kDone };

  void begin_agent(int agent) noexcept;
  void begin_leg() noexcept;
  int look(int rows) noexcept;
  void take_own(Cell first, std::uint64_t fresh) noexcept;
  [[nodiscard]] std::uint64_t visible(std::uint64_t word, int row, int byte, int& work) const noexcept;
  void begin_look(Point from, Seconds time_s) noexcept;

  const Cells* cells_ = nullptr;
  const Belief* belief_ = nullptr;
  StaticVector<WaypointPath, limits::kAgents> paths_;
  double max_unseen_mass_ = 0.0;
  Phase phase_ = Phase::kDone;
  int agent_ = 0;
  std::size_t leg_ = 0;  // to waypoint leg_ + 1
  int point_ = 0;
  int points_ = 0;
  Pace pace_{};
  Seconds leg_begin_s_{};
  int cell_ = 0;
  Point eye_{};  // the look under way: from where, when, and its next row
  Seconds eye_s_{};
  int row_ = 0;
  bool looking_ = false;
  SeenMap seen_;  // by the agent whose turn it is
  FirstSightings& sightings_;
  ExpectedTime expected_;
  // Own reading of Eq. 10: p_m is depleted by agent m alone.
  Mass own_mass_{};
  Mass own_mass_steps_{};
};

}  // namespace ivo::planner
