#include <gtest/gtest.h>

#include "tests/support/areas.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

class PlannerRefusal : public testing::Test {
 protected:
  PlannerRefusal() { m1_.problem().cell_m = 0.5; }

  Refusal prepare() { return planner_.prepare(m1_.problem()); }
  SearchProblem& problem() { return m1_.problem(); }

  test::M1 m1_{1};
  Planner& planner_ = test::shared_planner();
};

TEST_F(PlannerRefusal, IsNoneForASoundSearch) { EXPECT_FALSE(prepare()); }

TEST_F(PlannerRefusal, ComesFromTheCells) {
  problem().cell_m = 0.01;
  EXPECT_EQ(prepare().code, RefusalCode::kTooManyCells);
}

TEST_F(PlannerRefusal, ComesFromTheGraph) {
  problem().agents[1].body.start = {50.0, 1.0};
  const Refusal refusal = prepare();
  EXPECT_EQ(refusal.code, RefusalCode::kStartOutsideMap);
  EXPECT_EQ(refusal.agent, 1);
}

TEST_F(PlannerRefusal, ComesFromThePreferences) {
  ASSERT_TRUE(problem().agents[1].preferred.push_back(test::rectangle(50, 50, 60, 60)));
  const Refusal refusal = prepare();
  EXPECT_EQ(refusal.code, RefusalCode::kAreaWithoutMass);
  EXPECT_EQ(refusal.agent, 1);
  EXPECT_EQ(refusal.area, 0);
}

TEST_F(PlannerRefusal, LeavesNothingToDoAndNoPlan) {
  ASSERT_FALSE(prepare());
  (void)test::plan_of(planner_);
  problem().agents[0].body.start = {-1.0, 1.0};
  ASSERT_TRUE(prepare());
  const Progress progress = planner_.step({1000});
  EXPECT_TRUE(progress.done);
  EXPECT_FALSE(progress.has_plan);
}

TEST_F(PlannerRefusal, IsForgottenWithTheNextSoundSearch) {
  problem().agents[0].body.start = {-1.0, 1.0};
  ASSERT_TRUE(prepare());
  problem().agents[0].body.start = {1.75, 1.75};
  ASSERT_FALSE(prepare());
  EXPECT_TRUE(test::plan_of(planner_).score.complete);
}

}  // namespace
}  // namespace ivo::planner
