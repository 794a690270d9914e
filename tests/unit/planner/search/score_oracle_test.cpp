// The planner's scores against an evaluator that carries the whole map step by step.
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/naive_evaluator.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

constexpr double kAgreement = 1e-9;

test::NaiveEvaluator naive(const Planner& planner, const SearchProblem& problem, const Plan& plan) {
  const Belief& belief = planner.belief();
  const auto cells = planner.cells().count();
  test::NaiveMission mission{planner.cells(), {belief.mass.begin(), belief.mass.begin() + cells}, {}, 0};
  std::vector<test::NaivePath> paths;
  for (std::size_t m = 0; m < problem.agents.size(); ++m) {
    paths.push_back({plan.paths[m].waypoints.span(), problem.agents[m].speed_mps, problem.agents[m].sight_radius_m});
    if (belief.has_sub_priors) {
      mission.sub_priors.emplace_back(belief.sub_mass[m].begin(), belief.sub_mass[m].begin() + cells);
    }
  }
  mission.sub_prior_steps = static_cast<int>(belief.sub_prior_steps);
  return {std::move(mission), paths};
}

void expect_agreement(const Planner& planner, const SearchProblem& problem, const Plan& plan) {
  const test::NaiveEvaluator evaluator = naive(planner, problem, plan);
  const PlanScore expected = evaluator.score();
  EXPECT_NEAR(plan.score.expected_time_s, expected.expected_time_s, kAgreement);
  EXPECT_NEAR(plan.score.expected_time_continuous_s, expected.expected_time_continuous_s, kAgreement);
  EXPECT_NEAR(plan.score.expected_sub_prior_time_s, expected.expected_sub_prior_time_s, kAgreement);
  EXPECT_NEAR(plan.score.unseen_mass, expected.unseen_mass, kAgreement);
  EXPECT_NEAR(plan.score.horizon_s, expected.horizon_s, kAgreement);
  EXPECT_EQ(plan.score.complete, expected.unseen_mass <= problem.colony.ant.max_unseen_mass + 1e-9);
  const std::vector<double> last_new_s = evaluator.last_new_s();
  for (std::size_t m = 0; m < last_new_s.size(); ++m) {
    EXPECT_NEAR(plan.paths[m].duration_s, last_new_s[m], kAgreement) << "path of agent " << m;
  }
}

TEST(PlanScore, AgreesWithTheNaiveEvaluatorOnRandomSearches) {
  std::mt19937_64 random(2024);
  Planner& planner = test::shared_planner();
  static Plan plan;
  int searches = 0;
  int with_sub_priors = 0;
  int incomplete = 0;
  std::array<int, 4> of_agents{};
  for (int draw = 0; searches < 60; ++draw) {
    ASSERT_LT(draw, 600);
    test::RandomSearch search(random);
    if (planner.prepare(search.problem())) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    // Looked at three times: as soon as there is a plan, cut short somewhere, and at the end.
    while (!planner.step({50}).has_plan) {
    }
    planner.best_plan(plan);
    expect_agreement(planner, search.problem(), plan);
    planner.step({20'000});
    planner.best_plan(plan);
    expect_agreement(planner, search.problem(), plan);
    const Plan& last = test::plan_of(planner);
    expect_agreement(planner, search.problem(), last);
    with_sub_priors += planner.belief().has_sub_priors ? 1 : 0;
    incomplete += last.score.complete ? 0 : 1;
    ++of_agents[search.problem().agents.size()];
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(with_sub_priors, 10);
  EXPECT_GT(incomplete, 3);
  for (int agents = 1; agents <= 3; ++agents) {
    EXPECT_GT(of_agents[static_cast<std::size_t>(agents)], 5);
  }
}

}  // namespace
}  // namespace ivo::planner
