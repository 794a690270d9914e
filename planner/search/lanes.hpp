// A plan by lanes, as one mows a lawn: the map in strips, one an agent and as wide as it sweeps in equal time, each
// strip up and down in lanes not farther apart than the agent sees. Where the prior is even and little stands in the
// way this is close to the best there is, and a good plan to improve.
#pragma once

#include "planner/numeric/lattice.hpp"
#include "planner/search/segment_pool.hpp"

namespace ivo::planner {

/// Where and how each agent mows.
struct LaneTeam {
  std::int32_t width = 0;  ///< of the map, in ticks
  std::int32_t height = 0;
  std::int32_t border = 0;  ///< least distance of a waypoint from the border
  int agents = 0;
  std::array<Spot, limits::kAgents> starts{};
  std::array<std::int32_t, limits::kAgents> sight{};  ///< radius
  std::array<std::int32_t, limits::kAgents> sweep{};  ///< ticks^2 swept in some time: radius times speed, in any unit
};

using Lanes = StaticVector<Spot, limits::kWaypoints - 1>;

inline constexpr int kLanePlans = 6;

/// Waypoints of `agent` after its start in lane plan `number`, 0 to kLanePlans - 1: lanes along y or x, turning 1, 0.8
/// or 0.6 sight radii from the border. Empty when it would need more waypoints than there is room for. Cost: the
/// waypoints.
void fill_lanes(const LaneTeam& team, int agent, int number, Lanes& lanes) noexcept;

}  // namespace ivo::planner
