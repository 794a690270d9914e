// How good the fast profile's plans are after a stated amount of counted work: no clock is read.
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

constexpr int kGenerations = 170;
constexpr int kSeeds = 3;

double mean_expected_time_s(SearchProblem& problem) {
  double sum_s = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    problem.colony.seed = static_cast<std::uint64_t>(seed);
    EXPECT_FALSE(test::shared_planner().prepare(problem));
    const PlanScore& score = test::plan_of(test::shared_planner()).score;
    EXPECT_TRUE(score.complete);
    EXPECT_LE(score.unseen_mass, 0.014);
    sum_s += score.expected_time_continuous_s;
  }
  testing::Test::RecordProperty("mean_s", std::to_string(sum_s / kSeeds));
  return sum_s / kSeeds;
}

TEST(FastProfile, FindsInUnder77SecondsOnAnOpenSquareWithStartsFiveMetresFromTheSides) {
  test::M1 m1(kGenerations);
  m1.problem().graph.spacing_m = 5.0;
  m1.problem().agents[0].body.start = {2.5, 2.5};
  m1.problem().agents[1].body.start = {37.5, 2.5};
  EXPECT_LE(mean_expected_time_s(m1.problem()), 77.3);
}

TEST(FastProfile, FindsIn84SecondsOnAnOpenSquareFromItsCorners) {
  test::M1 m1(kGenerations);
  EXPECT_LE(mean_expected_time_s(m1.problem()), 83.8);
}

TEST(FastProfile, FindsIn37SecondsWhereTwoGaussiansSayWhereToLook) {
  test::M1 m1(kGenerations);
  const std::vector<GaussianComponent> gaussians = {{{12, 12}, 4.0, 1.0}, {{30, 28}, 4.0, 1.0}};
  m1.problem().prior = std::span<const GaussianComponent>(gaussians);
  EXPECT_LE(mean_expected_time_s(m1.problem()), 36.8);
}

}  // namespace
}  // namespace ivo::planner
