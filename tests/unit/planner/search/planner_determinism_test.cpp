#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/m1.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

// All that a plan says, to compare bit for bit.
std::vector<double> numbers_of(const Plan& plan) {
  const PlanScore& s = plan.score;
  std::vector<double> numbers = {
      s.expected_time_s, s.expected_time_continuous_s, s.expected_sub_prior_time_s, s.unseen_mass,
      s.horizon_s,       s.complete ? 1.0 : 0.0};
  for (const AgentPath& path : plan.paths) {
    numbers.insert(numbers.end(), {path.length_m, path.duration_s});
    for (const Point p : path.waypoints) {
      numbers.insert(numbers.end(), {p.x_m, p.y_m});
    }
  }
  return numbers;
}

std::vector<double> plan_in_slices(const SearchProblem& problem, int units) {
  static Plan plan;
  Planner& planner = test::shared_planner();
  EXPECT_FALSE(planner.prepare(problem));
  while (!planner.step({units}).done) {
  }
  planner.best_plan(plan);
  return numbers_of(plan);
}

TEST(Planner, MakesTheSamePlanHoweverTheWorkIsSliced) {
  test::M1 m1(3);
  m1.problem().graph.spacing_m = 5.0;
  m1.problem().cell_m = 0.5;
  ASSERT_TRUE(m1.problem().agents[1].preferred.push_back(test::rectangle(0, 20, 40, 40)));
  const std::vector<double> whole = plan_in_slices(m1.problem(), 1'000'000);
  for (const int units : {1, 7, 100, 4096}) {
    EXPECT_EQ(plan_in_slices(m1.problem(), units), whole) << "in slices of " << units;
  }
}

TEST(Planner, MakesTheSamePlanInSlicesOfRandomSizeOnRandomSearches) {
  std::mt19937_64 random(7);
  Planner& planner = test::shared_planner();
  static Plan plan;
  int searches = 0;
  for (int draw = 0; searches < 12; ++draw) {
    ASSERT_LT(draw, 300);
    test::RandomSearch search(random);
    if (planner.prepare(search.problem())) {
      continue;
    }
    ++searches;
    const std::vector<double> whole = numbers_of(test::plan_of(planner));
    ASSERT_FALSE(planner.prepare(search.problem()));
    while (!planner.step({1 + static_cast<int>(random() % 3000)}).done) {
    }
    planner.best_plan(plan);
    ASSERT_EQ(numbers_of(plan), whole) << "draw " << draw;
  }
}

TEST(Planner, MakesTheSamePlanForTheSameSeedAndAnotherForAnother) {
  test::M1 m1(60);  // the first plans come from ants that draw nothing, and from lanes
  m1.problem().cell_m = 0.5;
  const std::vector<double> first = plan_in_slices(m1.problem(), 1'000'000);
  m1.problem().colony.seed = 2;
  EXPECT_NE(plan_in_slices(m1.problem(), 1'000'000), first);
  m1.problem().colony.seed = 1;
  EXPECT_EQ(plan_in_slices(m1.problem(), 1'000'000), first);
}

TEST(Planner, DoesNoWorkWithoutABudgetAndNoneWhenDone) {
  test::M1 m1(1);
  m1.problem().cell_m = 0.5;
  Planner& planner = test::shared_planner();
  ASSERT_FALSE(planner.prepare(m1.problem()));
  EXPECT_FALSE(planner.step({0}).has_plan);
  EXPECT_EQ(planner.progress().generation, 0);
  EXPECT_EQ(planner.progress().generations, 1);
  const std::vector<double> plan = numbers_of(test::plan_of(planner));
  EXPECT_TRUE(planner.progress().done);
  EXPECT_EQ(planner.progress().generation, 1);
  planner.step({1'000'000});
  EXPECT_EQ(numbers_of(test::plan_of(planner)), plan);
}

}  // namespace
}  // namespace ivo::planner
