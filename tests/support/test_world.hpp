// What the parts of a search work on, from a planner that was prepared: to drive them one by one.
#pragma once

#include "planner/search/planner.hpp"
#include "planner/search/world.hpp"

namespace ivo::test {

/// Of one planner, for the life of the program. After each prepare(): set().
class TestWorld {
 public:
  explicit TestWorld(const planner::Planner& prepared)
      : world{prepared.cells(), prepared.graph(), prepared.sight(), prepared.belief(), paces_} {}

  void set(const planner::SearchProblem& problem) {
    for (std::size_t m = 0; m < problem.agents.size(); ++m) {
      for (planner::Edge e = 0; e < world.graph.edges(); ++e) {
        paces_[m][planner::index(e)] =
            planner::Pace(world.graph.length_m(e) / (world.sight.points(e) * problem.agents[m].speed_mps));
      }
    }
  }

 private:
  planner::EdgePaces paces_{};

 public:
  const planner::World world;
};

}  // namespace ivo::test
