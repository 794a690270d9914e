// The rivals' plans are real ones: collision-free, complete, worth what is said, and as good as their kind gets.
#include "firmware/tools/bench/rivals/rivals.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "firmware/tools/bench/rivals/free_ways.hpp"
#include "firmware/tools/bench/rivals/rival_score.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/naive_evaluator.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::firmware::rivals {
namespace {

constexpr Effort tries(int count) { return {.seconds = 60.0, .tries = count}; }

struct Scene {
  explicit Scene(const planner::SearchProblem& search)
      : coverage(test::shared_planner(), search), problem{test::shared_planner(), search, coverage} {}
  Coverage coverage;
  RivalProblem problem;
};

std::unique_ptr<Scene> prepared(const planner::SearchProblem& search) {
  if (test::shared_planner().prepare(search)) {
    return nullptr;
  }
  return std::make_unique<Scene>(search);
}

void expect_free(const RivalProblem& problem, const Waypoints& waypoints) {
  ASSERT_EQ(waypoints.size(), problem.search.agents.size());
  for (std::size_t m = 0; m < waypoints.size(); ++m) {
    const FreeWays ways(problem, static_cast<int>(m));
    EXPECT_EQ(waypoints[m].front(), problem.search.agents[m].body.start);
    for (std::size_t i = 1; i < waypoints[m].size(); ++i) {
      EXPECT_TRUE(ways.straight(waypoints[m][i - 1], waypoints[m][i])) << "agent " << m << ", move " << i;
    }
  }
}

double naive_expected_time_s(const RivalProblem& problem, const Waypoints& waypoints) {
  const planner::Belief& belief = problem.prepared.belief();
  test::NaiveMission mission{.cells = problem.prepared.cells(),
                             .prior = {belief.mass.begin(), belief.mass.begin() + belief.cells},
                             .sub_priors = {}};
  std::vector<test::NaivePath> paths;
  for (std::size_t m = 0; m < waypoints.size(); ++m) {
    paths.push_back({waypoints[m], problem.search.agents[m].speed_mps, problem.search.agents[m].sight_radius_m});
  }
  // The naive evaluator's horizon is the end of the waypoints; a path ends where it last sees something new.
  const planner::PlanScore score = test::NaiveEvaluator(std::move(mission), paths).score();
  return score.expected_time_continuous_s - score.unseen_mass * score.horizon_s;
}

TEST(Rivals, MakePlansOnRandomSearchesThatAreFreeCompleteAndWorthWhatIsSaid) {
  std::mt19937_64 random(11);
  int searches = 0;
  int completed = 0;
  for (int draw = 0; searches < 25; ++draw) {
    ASSERT_LT(draw, 400);
    test::RandomSearch search(random);
    const std::unique_ptr<Scene> scene = prepared(search.problem());
    if (scene == nullptr) {
      continue;
    }
    ++searches;
    for (const NamedRival& rival : all()) {
      SCOPED_TRACE(std::string(rival.name) + ", draw " + std::to_string(draw));
      const RivalPlan plan = rival.plan(scene->problem, tries(3), 1);
      expect_free(scene->problem, plan.waypoints);
      EXPECT_TRUE(plan.score.complete) << plan.score.unseen_mass;
      EXPECT_LE(plan.score.unseen_mass, search.problem().colony.ant.max_unseen_mass + 1e-9);
      EXPECT_NEAR(plan.score.expected_time_continuous_s - plan.score.unseen_mass * plan.score.horizon_s,
                  naive_expected_time_s(scene->problem, plan.waypoints), 1e-9);
      EXPECT_LE(plan.tries, 3);
      completed += plan.completed_greedily ? 1 : 0;
    }
  }
  EXPECT_GT(completed, 0);
}

TEST(Rivals, AreEachAsGoodOnM1AsTheirKindGets) {
  test::M1 m1(1);
  m1.problem().cell_m = 0.5;
  const std::unique_ptr<Scene> scene = prepared(m1.problem());
  ASSERT_NE(scene, nullptr);
  std::vector<double> expected_s;
  for (const NamedRival& rival : all()) {
    const RivalPlan plan =
        rival.plan(scene->problem, tries(rival.name == std::string("receding horizon") ? 4 : 300), 1);
    ASSERT_TRUE(plan.score.complete) << rival.name;
    expected_s.push_back(plan.score.expected_time_continuous_s);
    EXPECT_GT(expected_s.back(), 70.0) << rival.name;  // no complete plan is faster
    EXPECT_LT(expected_s.back(), 125.0) << rival.name;
  }
  EXPECT_LT(expected_s[1], expected_s[0]);  // looking farther ahead, and trying more, pays
  EXPECT_LT(expected_s[3], expected_s[0]);
}

TEST(Rivals, RepeatThemselvesForTheSameSeedAndTries) {
  test::M1 m1(1);
  m1.problem().cell_m = 0.5;
  const std::unique_ptr<Scene> scene = prepared(m1.problem());
  ASSERT_NE(scene, nullptr);
  for (const NamedRival& rival : all()) {
    EXPECT_EQ(rival.plan(scene->problem, tries(3), 3).waypoints, rival.plan(scene->problem, tries(3), 3).waypoints)
        << rival.name;
  }
}

TEST(Rivals, CountACellOnceWhateverRowsShowIt) {
  std::mt19937_64 random(3);
  int searches = 0;
  for (int draw = 0; searches < 5; ++draw) {
    ASSERT_LT(draw, 100);
    test::RandomSearch search(random);
    const std::unique_ptr<Scene> scene = prepared(search.problem());
    if (scene == nullptr) {
      continue;
    }
    ++searches;
    const planner::Planner& planner = test::shared_planner();
    for (planner::Edge e = 0; e < planner.graph().edges(); e += 7) {
      double sum = 0.0;
      for (const planner::SightEvent event : planner.sight().along_edge(0, e)) {
        sum += planner.belief().mass[static_cast<std::size_t>(event.cell())];
      }
      EXPECT_NEAR(scene->coverage.new_mass(scene->coverage.along(0, e), CellSet(scene->coverage.words(), 0)), sum,
                  1e-12);
      EXPECT_EQ(scene->coverage.new_mass(scene->coverage.along(0, e), CellSet(scene->coverage.words(), ~0ULL)), 0.0);
    }
  }
}

}  // namespace
}  // namespace ivo::firmware::rivals
