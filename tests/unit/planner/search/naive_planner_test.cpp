// The planner against one that looks everything up the long way: the same seed gives the same plan, in doubles; another
// in fixed point, where draws and trails are rounded.
#include "tests/support/naive_planner.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/m1.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

constexpr double kSameScore = 1e-9;

void expect_same(const Plan& plan, const test::NaivePlan& naive) {
  EXPECT_NEAR(plan.score.expected_time_s, naive.score.expected_time_s, kSameScore);
  EXPECT_NEAR(plan.score.expected_time_continuous_s, naive.score.expected_time_continuous_s, kSameScore);
  EXPECT_NEAR(plan.score.expected_sub_prior_time_s, naive.score.expected_sub_prior_time_s, kSameScore);
  EXPECT_NEAR(plan.score.unseen_mass, naive.score.unseen_mass, kSameScore);
  EXPECT_NEAR(plan.score.horizon_s, naive.score.horizon_s, kSameScore);
  EXPECT_EQ(plan.score.complete, naive.score.complete);
  ASSERT_EQ(plan.paths.size(), naive.waypoints.size());
  for (std::size_t m = 0; m < naive.waypoints.size(); ++m) {
    SCOPED_TRACE("agent " + std::to_string(m));
    ASSERT_EQ(plan.paths[m].waypoints.size(), naive.waypoints[m].size());
    for (std::size_t i = 0; i < naive.waypoints[m].size(); ++i) {
      EXPECT_NEAR(plan.paths[m].waypoints[i].x_m, naive.waypoints[m][i].x_m, kSameScore);
      EXPECT_NEAR(plan.paths[m].waypoints[i].y_m, naive.waypoints[m][i].y_m, kSameScore);
    }
  }
}

class PaperColony : public testing::Test {
 protected:
  void SetUp() override {
    if (kFixedPoint) {
      GTEST_SKIP() << "the naive planner decides in doubles";
    }
  }
};

TEST_F(PaperColony, MakesTheNaivePlannersPlanOnRandomSearches) {
  std::mt19937_64 random(31);
  Planner& planner = test::shared_planner();
  int searches = 0;
  int with_sub_priors = 0;
  int incomplete = 0;
  int of_several = 0;
  for (int draw = 0; searches < 100; ++draw) {
    ASSERT_LT(draw, 1500);
    test::RandomSearch search(random);
    search.problem().colony.profile = Profile::kPaper;
    if (planner.prepare(search.problem())) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    const Plan& plan = test::plan_of(planner);
    expect_same(plan, test::NaivePlanner(planner, search.problem()).plan());
    ASSERT_FALSE(HasFailure());
    with_sub_priors += planner.belief().has_sub_priors ? 1 : 0;
    incomplete += plan.score.complete ? 0 : 1;
    of_several += search.problem().agents.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(with_sub_priors, 20);
  EXPECT_GT(incomplete, 5);
  EXPECT_GT(of_several, 40);
}

TEST_F(PaperColony, MakesTheNaivePlannersPlanOnAShortM1WithAndWithoutSubPriors) {
  for (const bool preferences : {false, true}) {
    test::M1 m1(6);
    m1.problem().cell_m = 0.5;
    m1.problem().colony.ants = 3;
    m1.problem().colony.profile = Profile::kPaper;
    if (preferences) {
      ASSERT_TRUE(m1.problem().agents[1].preferred.push_back(test::rectangle(0, 20, 40, 40)));
    }
    Planner& planner = test::shared_planner();
    ASSERT_FALSE(planner.prepare(m1.problem()));
    expect_same(test::plan_of(planner), test::NaivePlanner(planner, m1.problem()).plan());
  }
}

}  // namespace
}  // namespace ivo::planner
