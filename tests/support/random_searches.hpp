// Tests over many random searches.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>

#include "tests/support/random_search.hpp"

namespace ivo::test {

/// All but starts and speeds: the agents may take over each other's ways.
inline void make_alike(planner::SearchProblem& problem) {
  for (planner::SearchAgent& agent : problem.agents) {
    agent.body.kind = problem.agents[0].body.kind;
    agent.body.footprint_radius_m = problem.agents[0].body.footprint_radius_m;
    agent.body.restricted.clear();
    agent.sight_radius_m = problem.agents[0].sight_radius_m;
  }
}

/// Draws until `opens(draw, problem)` has taken `count` of them, and calls `on_search(problem, random)` for each.
template <class Opens, class OnSearch>
void on_random_searches(std::uint64_t seed, int count, Opens&& opens, OnSearch&& on_search) {
  std::mt19937_64 random(seed);
  int searches = 0;
  for (int draw = 0; searches < count; ++draw) {
    ASSERT_LT(draw, 20 * count);
    RandomSearch search(random);
    if (!opens(draw, search.problem())) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    on_search(search.problem(), random);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

}  // namespace ivo::test
