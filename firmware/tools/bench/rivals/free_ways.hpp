// Ways between any two places for one agent: straight where the footprint swept along is free, else over the graph.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "firmware/tools/bench/rivals/rivals.hpp"
#include "planner/world/collision.hpp"

namespace ivo::firmware::rivals {

[[nodiscard]] inline double distance_m(Point a, Point b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

class FreeWays {
 public:
  FreeWays(const RivalProblem& problem, int agent);

  /// Footprint clear of obstacles, restricted classes and the border, path clear of restricted areas.
  [[nodiscard]] bool straight(Point a, Point b) const;
  /// The nearest node that the agent can get to straight from `p`, among the nearest few.
  [[nodiscard]] std::optional<planner::Node> node_near(Point p) const;
  /// Waypoints from `a`, not included, to `b`; nothing when there is no way. Corners that can be cut are.
  [[nodiscard]] std::optional<std::vector<Point>> way(Point a, Point b) const;

 private:
  [[nodiscard]] std::vector<Point> over_the_graph(planner::Node from, planner::Node to) const;

  const RivalProblem& problem_;
  int agent_;
  const planner::GraphAgent& body_;
  planner::ClassSet blocked_;
};

}  // namespace ivo::firmware::rivals
