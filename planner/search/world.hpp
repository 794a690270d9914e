// What every part of a search works on: tables made once, and read by all colonies.
#pragma once

#include <array>

#include "planner/numeric/scalar.hpp"
#include "planner/search/belief.hpp"
#include "planner/world/graph.hpp"
#include "planner/world/sight_table.hpp"

namespace ivo::planner {

/// Who moves: what decides whether a way is free and what is seen along it.
struct Body {
  AgentKind kind = AgentKind::kRobot;
  double footprint_radius_m = 0.30;
  double sight_radius_m = 2.5;
  Areas restricted;

  /// A way of one is good for the other.
  [[nodiscard]] bool like(const Body& other) const noexcept {
    return kind == other.kind && footprint_radius_m == other.footprint_radius_m &&
           sight_radius_m == other.sight_radius_m && restricted.empty() && other.restricted.empty();
  }
};
using Bodies = StaticVector<Body, limits::kAgents>;

/// Seconds that each agent takes from one sight point of an edge to the next.
using EdgePaces = std::array<std::array<Pace, limits::kEdges>, limits::kAgents>;

struct World {
  const Cells& cells;
  const Graph& graph;
  const SightTable& sight;
  const Belief& belief;
  const EdgePaces& paces;
  const std::array<double, limits::kAgents>& speeds_mps;
  const SegmentedMap& map;
  const Bodies& bodies;
  const double& clearance_m;  ///< of a waypoint to the nearest obstacle

  [[nodiscard]] Pace pace(int agent, Edge e) const noexcept { return paces[index(agent)][index(e)]; }
  /// The time of the edge's last sight point to the last bit, so that a path that ends there does not seem to enter the
  /// next edge.
  [[nodiscard]] Seconds seconds_along(int agent, Edge e) const noexcept {
    return after_points(pace(agent, e), sight.points(e));
  }
};

}  // namespace ivo::planner
