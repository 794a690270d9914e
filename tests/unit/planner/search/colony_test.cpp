// What the colony finds: the figures of model.md, "What Table I pins down", and "Sub-priors".
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/areas.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

const Plan& plan_for(SearchProblem& problem) {
  Planner& planner = test::shared_planner();
  problem.colony.profile = Profile::kPaper;
  EXPECT_EQ(planner.prepare(problem).code, RefusalCode::kNone);
  return test::plan_of(planner);
}

TEST(Colony, FindsOnM1WithAUniformPriorWhatThePrototypeFound) {
  constexpr std::array<double, 3> kExpected_s = {104.13, 105.48, 103.98};  // by the decisions of seeds 1 to 3
  double sum_s = 0.0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    test::M1 m1(400, seed);
    const PlanScore score = plan_for(m1.problem()).score;
    if (!kFixedPoint) {
      EXPECT_NEAR(score.expected_time_s, kExpected_s[seed - 1], 0.006);
    }
    EXPECT_TRUE(score.complete);
    EXPECT_LE(score.unseen_mass, 0.014 + 1e-9);
    EXPECT_GT(score.expected_time_continuous_s, 76.1);  // no complete plan can be faster
    EXPECT_NEAR(score.expected_time_continuous_s - score.expected_time_s, 0.5, 0.1);
    sum_s += score.expected_time_s;
  }
  EXPECT_EQ(test::shared_planner().graph().nodes(), 144);
  EXPECT_EQ(test::shared_planner().belief().sub_prior_steps, 640);
  EXPECT_GT(sum_s / 3, 101.0);
  EXPECT_LT(sum_s / 3, 108.0);
}

TEST(Colony, CompletesAPlanThatMayLeaveNothingUnseen) {
  test::M1 m1(2);
  m1.problem().graph.spacing_m = 5.0;
  m1.problem().colony.ant.max_unseen_mass = 0.0;
  for (SearchAgent& agent : m1.problem().agents) {
    agent.sight_radius_m = 5.0;  // a square and more
  }
  const PlanScore score = plan_for(m1.problem()).score;
  EXPECT_TRUE(score.complete);
  EXPECT_EQ(score.unseen_mass, 0.0);
}

TEST(Colony, FindsBetterPlansWithMoreGenerations) {
  test::M1 few(1);
  few.problem().cell_m = 0.5;
  const double first_s = plan_for(few.problem()).score.expected_time_s;
  test::M1 many(150);
  many.problem().cell_m = 0.5;
  EXPECT_LT(plan_for(many.problem()).score.expected_time_s, first_s - 2.0);
}

TEST(Colony, NeedsMuchLongerWhenEachAgentIsSentToTheGaussianFarFromIt) {
  const std::vector<GaussianComponent> gaussians = {{{10.0, 16.0}, 3.5, 1.0}, {{30.0, 16.0}, 3.5, 1.0}};
  const Area left = test::rectangle(0, 0, 20, 40);
  const Area right = test::rectangle(20, 0, 40, 40);
  std::vector<double> expected_s;
  for (const bool exchanged : {false, true}) {
    test::M1 m1(60);
    m1.problem().cell_m = 0.5;
    m1.problem().prior = std::span<const GaussianComponent>(gaussians);
    ASSERT_TRUE(m1.problem().agents[0].preferred.push_back(exchanged ? right : left));
    ASSERT_TRUE(m1.problem().agents[1].preferred.push_back(exchanged ? left : right));
    const PlanScore score = plan_for(m1.problem()).score;
    EXPECT_TRUE(score.complete);
    expected_s.push_back(score.expected_time_s);
  }
  EXPECT_GT(expected_s[1], 1.25 * expected_s[0]);
}

// Share by length of a path inside the area.
double share_inside(const AgentPath& path, const Area& area) {
  double inside = 0.0;
  double whole = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    const Point a = path.waypoints[i - 1];
    const Point b = path.waypoints[i];
    const double piece = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / 100;
    for (int k = 0; k < 100; ++k) {
      const double t = (k + 0.5) / 100;
      whole += piece;
      inside += contains(area, {a.x_m + (b.x_m - a.x_m) * t, a.y_m + (b.y_m - a.y_m) * t}) ? piece : 0.0;
    }
  }
  return inside / whole;
}

TEST(Colony, SpendsMoreOfAnAgentsPathInTheAreaThatItPrefers) {
  const Area upper_left = test::rectangle(0, 20, 20, 40);
  test::M1 without(60);
  without.problem().cell_m = 0.5;
  const double share_without = share_inside(plan_for(without.problem()).paths[1], upper_left);
  test::M1 with(60);
  with.problem().cell_m = 0.5;
  ASSERT_TRUE(with.problem().agents[1].preferred.push_back(upper_left));  // far from its start
  const Plan& plan = plan_for(with.problem());
  EXPECT_GT(plan.score.expected_sub_prior_time_s, 0.0);
  EXPECT_GT(share_inside(plan.paths[1], upper_left), share_without + 0.2);
  EXPECT_LT(share_inside(plan.paths[0], upper_left), share_inside(plan.paths[1], upper_left));
}

// The best plan's rank after every piece of work: complete before incomplete, then by cost, or by unseen mass.
TEST(Colony, NeverTradesACompletePlanForAnIncompleteOneNorALessUnseenForAMore) {
  int completed_later = 0;
  int improved_incomplete = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    test::M1 m1(12, seed);
    m1.problem().colony.profile = Profile::kPaper;
    m1.problem().cell_m = 0.5;
    m1.problem().colony.ants = 2;
    // A disc does not cover its square: what is left can be seen from edges only, and many ants end without it.
    for (SearchAgent& agent : m1.problem().agents) {
      agent.sight_radius_m = 1.6;
    }
    m1.problem().colony.ant.max_unseen_mass = 0.03;
    Planner& planner = test::shared_planner();
    ASSERT_FALSE(planner.prepare(m1.problem()));
    PlanScore before;
    bool had_plan = false;
    while (!planner.progress().done) {
      const Progress progress = planner.step({2000});
      if (!progress.has_plan) {
        continue;
      }
      const PlanScore& now = progress.best;
      ASSERT_EQ(now.complete, now.unseen_mass <= 0.03 + 1e-9);
      if (had_plan && before.complete) {
        ASSERT_TRUE(now.complete);
        ASSERT_LE(now.expected_time_s, before.expected_time_s);
      } else if (had_plan && !now.complete) {
        ASSERT_LE(now.unseen_mass, before.unseen_mass);
        improved_incomplete += now.unseen_mass < before.unseen_mass ? 1 : 0;
      } else if (had_plan) {
        ++completed_later;
      }
      before = now;
      had_plan = true;
    }
    EXPECT_TRUE(before.complete) << "seed " << seed;  // a dearer complete plan takes the place of an incomplete one
  }
  EXPECT_GT(completed_later, 0);
  EXPECT_GT(improved_incomplete, 0);
}

}  // namespace
}  // namespace ivo::planner
