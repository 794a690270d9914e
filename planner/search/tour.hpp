// What an ant built: edges for every agent, and what is known of their worth.
#pragma once

#include <array>

#include "config/base/static_vector.hpp"
#include "planner/numeric/scalar.hpp"
#include "planner/search/plan.hpp"
#include "planner/world/graph.hpp"

namespace ivo::planner {

/// Edges that an agent takes, in order, from its start.
using EdgePath = StaticVector<Edge, limits::kWaypoints - 1>;

/// What a plan costs, in seconds of Eq. 8 or EST; a scored tour's interval is a point.
struct CostInterval {
  Mass low{};
  Mass high{};
};

struct Tour {
  StaticVector<EdgePath, limits::kAgents> paths;
  bool complete = false;
  Mass unseen{};  ///< exact
  CostInterval cost;
  bool scored = false;  ///< exactly; then paths end where they last show something new, and the following holds
  std::array<Seconds, limits::kAgents> end_s{};
  PlanScore score;

  /// As `other`, for the cost of its edges.
  void assign(const Tour& other) noexcept {
    paths.resize(other.paths.size());
    for (std::size_t m = 0; m < paths.size(); ++m) {
      paths[m].assign(other.paths[m]);
    }
    complete = other.complete;
    unseen = other.unseen;
    cost = other.cost;
    scored = other.scored;
    end_s = other.end_s;
    score = other.score;
  }
};

}  // namespace ivo::planner
