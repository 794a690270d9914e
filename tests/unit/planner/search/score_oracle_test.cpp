// The planner's scores against an evaluator that carries the whole map step by step.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/agreement.hpp"
#include "tests/support/masses.hpp"
#include "tests/support/naive_evaluator.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using test::kAgreement;
using test::kStepAgreement;

test::NaiveEvaluator naive(const Planner& planner, const SearchProblem& problem, const Plan& plan) {
  const Belief& belief = planner.belief();
  const auto cells = planner.cells().count();
  test::NaiveMission mission{planner.cells(), test::as_doubles(belief.mass, cells), {}};
  std::vector<test::NaivePath> paths;
  for (std::size_t m = 0; m < problem.agents.size(); ++m) {
    paths.push_back({plan.paths[m].waypoints.span(), problem.agents[m].speed_mps, problem.agents[m].sight_radius_m});
    if (belief.has_sub_priors) {
      mission.sub_priors.push_back(test::as_doubles(belief.sub_mass[m], cells));
    }
  }
  mission.sub_prior_steps = static_cast<int>(belief.sub_prior_steps);
  return {std::move(mission), paths};
}

void expect_agreement(const Planner& planner, const SearchProblem& problem, const Plan& plan) {
  const test::NaiveEvaluator evaluator = naive(planner, problem, plan);
  const PlanScore expected = evaluator.score();
  EXPECT_NEAR(plan.score.expected_time_s, expected.expected_time_s, kStepAgreement);
  EXPECT_NEAR(plan.score.expected_time_continuous_s, expected.expected_time_continuous_s, kAgreement);
  EXPECT_NEAR(plan.score.expected_sub_prior_time_s, expected.expected_sub_prior_time_s, kStepAgreement);
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
  int with_restricted_areas = 0;
  int with_stairs_before_a_robot = 0;
  int from_images = 0;
  std::array<int, limits::kAgents + 1> of_agents{};
  for (int draw = 0; searches < 60; ++draw) {
    ASSERT_LT(draw, 600);
    test::RandomSearch search(random);
    if (planner.prepare(search.problem())) {
      continue;
    }
    if (++searches % 2 == 0) {
      search.problem().colony.profile = Profile::kPaper;
      ASSERT_FALSE(planner.prepare(search.problem()));
    }
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
    const SearchProblem& problem = search.problem();
    ++of_agents[problem.agents.size()];
    with_restricted_areas += std::any_of(problem.agents.begin(), problem.agents.end(),
                                         [](const SearchAgent& agent) { return !agent.body.restricted.empty(); })
                                 ? 1
                                 : 0;
    with_stairs_before_a_robot +=
        std::count(problem.map.pixels.begin(), problem.map.pixels.end(), SemanticClass::kStairs) > 0 &&
                std::any_of(problem.agents.begin(), problem.agents.end(),
                            [](const SearchAgent& agent) { return agent.body.kind == AgentKind::kRobot; })
            ? 1
            : 0;
    from_images += std::holds_alternative<GreyView>(problem.prior) ? 1 : 0;
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(with_sub_priors, 10);
  EXPECT_GT(incomplete, 3);
  EXPECT_GT(with_restricted_areas, 10);
  EXPECT_GT(with_stairs_before_a_robot, 10);
  EXPECT_GT(from_images, 5);
  for (int agents = 1; agents <= limits::kAgents && agents <= 4; ++agents) {
    EXPECT_GT(of_agents[static_cast<std::size_t>(agents)], 5);
  }
}

}  // namespace
}  // namespace ivo::planner
