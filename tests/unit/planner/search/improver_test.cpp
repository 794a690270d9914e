// What the fast profile shows while it improves a plan: each plan is one that the agents can follow, worth what is said
// of it, and no worse than the one before.
#include "planner/search/improver.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "planner/world/collision.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/random_searches.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

constexpr double kClose = 1e-9;

double cost(const PlanScore& score) {
  return test::shared_planner().belief().has_sub_priors ? score.expected_sub_prior_time_s
                                                        : score.expected_time_continuous_s;
}

// Complete plans before others, those by cost, others by unseen mass.
bool worse(const PlanScore& a, const PlanScore& b) {
  if (a.complete != b.complete) {
    return b.complete;
  }
  return a.complete ? cost(a) > cost(b) : a.unseen_mass > b.unseen_mass;
}

void expect_worth_what_is_said(const SearchProblem& problem, const Plan& plan) {
  static FirstSightings sightings;
  static PathScorer scorer(sightings);
  std::vector<WaypointPath> paths;
  for (std::size_t m = 0; m < plan.paths.size(); ++m) {
    const SearchAgent& agent = problem.agents[m];
    paths.push_back({plan.paths[m].waypoints.span(), agent.speed_mps, agent.sight_radius_m});
  }
  const Planner& planner = test::shared_planner();
  const PlanScore exact = scorer.score(planner.cells(), planner.belief(), paths, problem.colony.ant.max_unseen_mass);
  EXPECT_NEAR(plan.score.expected_time_s, exact.expected_time_s, kClose);
  EXPECT_NEAR(plan.score.expected_time_continuous_s, exact.expected_time_continuous_s, kClose);
  EXPECT_NEAR(plan.score.expected_sub_prior_time_s, exact.expected_sub_prior_time_s, kClose);
  EXPECT_NEAR(plan.score.unseen_mass, exact.unseen_mass, kClose);
  EXPECT_NEAR(plan.score.horizon_s, exact.horizon_s, kClose);
  EXPECT_EQ(plan.score.complete, exact.complete);
  for (std::size_t m = 0; m < plan.paths.size(); ++m) {
    EXPECT_NEAR(plan.paths[m].duration_s, scorer.path_end_s(static_cast<int>(m)), kClose);
    EXPECT_NEAR(plan.paths[m].length_m, length_m(plan.paths[m].waypoints.span()),
                kFixedPoint ? test::kAgreement : 1e-6);
  }
}

void expect_every_agent_can_follow(const SearchProblem& problem, const Plan& plan) {
  const SegmentedMap& map = problem.map;
  ASSERT_EQ(plan.paths.size(), problem.agents.size());
  for (std::size_t m = 0; m < plan.paths.size(); ++m) {
    const GraphAgent& body = problem.agents[m].body;
    const auto blocked =
        static_cast<ClassSet>(obstacle_classes(map.classes) | restricted_classes(map.classes, body.kind));
    const auto& waypoints = plan.paths[m].waypoints;
    ASSERT_FALSE(waypoints.empty());
    EXPECT_EQ(waypoints[0].x_m, body.start.x_m);
    EXPECT_EQ(waypoints[0].y_m, body.start.y_m);
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
      EXPECT_TRUE(swept_disc_is_free(map, blocked, waypoints[i - 1], waypoints[i], body.footprint_radius_m))
          << "agent " << m << " on its way to waypoint " << i << " of " << waypoints.size();
      EXPECT_FALSE(touches(body.restricted, waypoints[i - 1], waypoints[i]))
          << "agent " << m << " on its way to waypoint " << i;
    }
  }
}

int off_the_graph(const Plan& plan) {
  const Graph& graph = test::shared_planner().graph();
  int count = 0;
  for (const AgentPath& path : plan.paths) {
    for (std::size_t i = 1; i + 1 < path.waypoints.size(); ++i) {
      bool node = false;
      for (Node n = 0; n < graph.nodes() && !node; ++n) {
        node = graph.position(n).x_m == path.waypoints[i].x_m && graph.position(n).y_m == path.waypoints[i].y_m;
      }
      count += node ? 0 : 1;
    }
  }
  return count;
}

// Searches to the end, in slices; checks every plan that is shown. Returns how often another was shown.
int search_and_check(const SearchProblem& problem, Plan& plan) {
  Planner& planner = test::shared_planner();
  PlanScore shown;
  bool any = false;
  int plans = 0;
  for (Progress progress = planner.progress(); !progress.done && !testing::Test::HasFailure();) {
    progress = planner.step({3'000});
    EXPECT_TRUE(progress.has_plan || !any) << "a plan was shown before";
    if (!progress.has_plan) {
      continue;
    }
    EXPECT_FALSE(any && worse(progress.best, shown)) << cost(progress.best) << " after " << cost(shown);
    if (!any || cost(progress.best) != cost(shown) || progress.best.unseen_mass != shown.unseen_mass) {
      ++plans;
      planner.best_plan(plan);
      EXPECT_EQ(cost(plan.score), cost(progress.best));
      expect_worth_what_is_said(problem, plan);
      expect_every_agent_can_follow(problem, plan);
    }
    any = true;
    shown = progress.best;
  }
  EXPECT_TRUE(any);
  return plans;
}

TEST(Improver, ShowsOnlyPlansThatCanBeFollowedAreWorthWhatIsSaidAndGetBetter) {
  std::mt19937_64 random(61);
  static Plan plan;
  std::array<int, limits::kAgents + 1> of_agents{};
  int with_sub_priors = 0;
  int off_graph = 0;
  int improved = 0;
  int searches = 0;
  for (int draw = 0; searches < 60; ++draw) {
    ASSERT_LT(draw, 600);
    test::RandomSearch search(random);
    search.problem().colony.generations = 14;
    if (draw % 2 == 0) {
      test::make_alike(search.problem());
    }
    if (test::shared_planner().prepare(search.problem())) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    improved += search_and_check(search.problem(), plan) > 1 ? 1 : 0;
    ASSERT_FALSE(HasFailure());
    off_graph += off_the_graph(plan) > 0 ? 1 : 0;
    ++of_agents[search.problem().agents.size()];
    with_sub_priors += test::shared_planner().belief().has_sub_priors ? 1 : 0;
  }
  for (std::size_t agents = 1; agents <= std::min<std::size_t>(4, limits::kAgents); ++agents) {
    EXPECT_GT(of_agents[agents], 3) << agents << " agents";
  }
  EXPECT_GT(with_sub_priors, 8);
  EXPECT_GT(off_graph, 20);
  EXPECT_GT(improved, 40);
}

TEST(Improver, ShowsOnlySuchPlansOfAnOpenSquareWithAndWithoutSubPriors) {
  static Plan plan;
  for (const bool sub_priors : {false, true}) {
    SCOPED_TRACE(sub_priors ? "with sub-priors" : "without");
    test::M1 m1(25);
    if (sub_priors) {
      ASSERT_TRUE(m1.problem().agents[1].preferred.push_back(test::rectangle(0, 20, 40, 40)));
    }
    ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
    ASSERT_EQ(test::shared_planner().belief().has_sub_priors, sub_priors);
    EXPECT_GT(search_and_check(m1.problem(), plan), 5);
    EXPECT_GT(off_the_graph(plan), 5);
    EXPECT_TRUE(plan.score.complete);
  }
}

TEST(Improver, TakesATenthOffWhatTheShortColonyFound) {
  test::M1 m1(5);
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  const double colony_s = test::plan_of(test::shared_planner()).score.expected_time_continuous_s;
  m1.problem().colony.generations = 40;
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  const double improved_s = test::plan_of(test::shared_planner()).score.expected_time_continuous_s;
  EXPECT_LT(improved_s, 0.9 * colony_s);
}

// All that a plan says, to compare bit for bit.
std::vector<double> all_said_by(const Plan& plan) {
  const PlanScore& s = plan.score;
  std::vector<double> numbers = {s.expected_time_s, s.expected_time_continuous_s, s.expected_sub_prior_time_s,
                                 s.unseen_mass, s.horizon_s};
  for (const AgentPath& path : plan.paths) {
    numbers.insert(numbers.end(), {path.length_m, path.duration_s});
    for (const Point p : path.waypoints) {
      numbers.insert(numbers.end(), {p.x_m, p.y_m});
    }
  }
  return numbers;
}

std::vector<double> improved_in_slices(const SearchProblem& problem, int units) {
  static Plan plan;
  Planner& planner = test::shared_planner();
  EXPECT_FALSE(planner.prepare(problem));
  while (!planner.step({units}).done) {
  }
  planner.best_plan(plan);
  return all_said_by(plan);
}

void expect_same_plan_however_sliced(const SearchProblem& problem) {
  const std::vector<double> whole = improved_in_slices(problem, 10'000);
  for (const int units : {1, 97}) {
    EXPECT_EQ(improved_in_slices(problem, units), whole) << "in slices of " << units;
  }
}

TEST(Improver, MakesTheSamePlanHoweverTheWorkIsSliced) {
  test::M1 m1(12);
  m1.problem().cell_m = 0.5;
  expect_same_plan_however_sliced(m1.problem());
  ASSERT_TRUE(m1.problem().agents[1].preferred.push_back(test::rectangle(0, 20, 40, 40)));
  expect_same_plan_however_sliced(m1.problem());
}

TEST(Improver, MakesTheSamePlanHoweverTheWorkIsSlicedOnRandomSearches) {
  std::mt19937_64 random(62);
  int searches = 0;
  for (int draw = 0; searches < 8; ++draw) {
    ASSERT_LT(draw, 200);
    test::RandomSearch search(random);
    search.problem().colony.generations = 8;
    if (test::shared_planner().prepare(search.problem())) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    expect_same_plan_however_sliced(search.problem());
  }
}

}  // namespace
}  // namespace ivo::planner
