// M1 of the paper: 40 x 40 m without obstacles, two agents at 1 m/s from the lower corners (model.md, "What Table I
// pins down").
#pragma once

#include "planner/search/planner.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo::test {

class M1 {
 public:
  explicit M1(int generations, std::uint64_t seed = 1) {
    problem_.map = map_.view();
    problem_.colony.generations = generations;
    problem_.colony.seed = seed;
    problem_.agents.resize(2);
    problem_.agents[0].body.start = {1.75, 1.75};
    problem_.agents[1].body.start = {39.25, 1.75};
    for (planner::SearchAgent& agent : problem_.agents) {
      agent.speed_mps = 1.0;
    }
  }
  M1(const M1&) = delete;
  M1& operator=(const M1&) = delete;

  /// To change before it is used.
  [[nodiscard]] planner::SearchProblem& problem() { return problem_; }

 private:
  DrawnMap map_{40.0, 40.0, 0.25};
  planner::SearchProblem problem_;
};

}  // namespace ivo::test
