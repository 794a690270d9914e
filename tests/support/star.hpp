// A graph of one node in the middle and neighbours on a circle around it: more than a built graph's node has.
#pragma once

#include <cmath>
#include <vector>

#include "planner/world/graph_table.hpp"

namespace ivo::test {

/// For one agent, who starts in the middle.
class Star {
 public:
  Star(Point middle, int neighbours, double radius_m) : radius_m_(radius_m), positions_{middle}, first_edge_{0} {
    for (int i = 0; i < neighbours; ++i) {
      const double angle = 2.0 * M_PI * i / neighbours;
      positions_.push_back({middle.x_m + radius_m * std::cos(angle), middle.y_m + radius_m * std::sin(angle)});
      heads_.push_back(i + 1);
    }
    first_edge_.push_back(neighbours);
    for (int i = 0; i < neighbours; ++i) {
      heads_.push_back(0);
      first_edge_.push_back(neighbours + i + 1);
    }
    open_to_.assign(heads_.size(), planner::AgentSet{1});
  }

  /// Valid as long as this is.
  [[nodiscard]] planner::GraphTable table() const {
    return {.spacing_m = radius_m_,
            .agents = 1,
            .positions = positions_,
            .first_edge = first_edge_,
            .heads = heads_,
            .open_to = open_to_};
  }

 private:
  double radius_m_;
  std::vector<Point> positions_;
  std::vector<planner::Edge> first_edge_;
  std::vector<planner::Node> heads_;
  std::vector<planner::AgentSet> open_to_;
};

}  // namespace ivo::test
