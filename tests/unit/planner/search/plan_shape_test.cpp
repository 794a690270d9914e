#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/agreement.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using test::kAgreement;

double distance_m(Point a, Point b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

bool on_the_way(Point p, Point a, Point b) {
  return std::abs(distance_m(a, p) + distance_m(p, b) - distance_m(a, b)) < 1e-9;
}

// An edge open to the agent that leads from `a` to, or over, `b`.
bool joined(const Graph& graph, int agent, Point a, Point b, bool to_the_end) {
  for (Node n = 0; n < graph.nodes(); ++n) {
    for (Edge e = graph.first_edge(n); distance_m(graph.position(n), a) < 1e-12 && e < graph.end_edge(n); ++e) {
      const Point head = graph.position(graph.head(e));
      if (in(graph.open_to(e), agent) && (to_the_end ? distance_m(head, b) < 1e-12 : on_the_way(b, a, head))) {
        return true;
      }
    }
  }
  return false;
}

TEST(Plan, RunsAlongEdgesThatItsAgentMayUseFromItsStart) {
  std::mt19937_64 random(13);
  Planner& planner = test::shared_planner();
  int searches = 0;
  for (int draw = 0; searches < 40; ++draw) {
    ASSERT_LT(draw, 400);
    test::RandomSearch search(random);
    search.problem().colony.profile = Profile::kPaper;
    const SearchProblem& problem = search.problem();
    if (planner.prepare(problem)) {
      continue;
    }
    ++searches;
    const Plan& plan = test::plan_of(planner);
    ASSERT_EQ(plan.paths.size(), problem.agents.size());
    double horizon_s = 0.0;
    for (std::size_t m = 0; m < plan.paths.size(); ++m) {
      const AgentPath& path = plan.paths[m];
      ASSERT_EQ(path.waypoints[0], problem.agents[m].body.start);
      double length_m = 0.0;
      for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
        const Point a = path.waypoints[i - 1];
        const Point b = path.waypoints[i];
        ASSERT_TRUE(joined(planner.graph(), static_cast<int>(m), a, b, i + 1 < path.waypoints.size())) << "leg " << i;
        ASSERT_GT(distance_m(a, b), 1e-6) << "leg " << i << " leads nowhere";
        length_m += distance_m(a, b);
      }
      ASSERT_NEAR(path.length_m, length_m, kAgreement);
      ASSERT_NEAR(path.duration_s, length_m / problem.agents[m].speed_mps, kAgreement / problem.agents[m].speed_mps);
      horizon_s = std::max(horizon_s, path.duration_s);
    }
    ASSERT_EQ(plan.score.horizon_s, horizon_s);
  }
}

TEST(Plan, MayLeaveTheGraphInTheFastProfileButMeetsNoObstacleNorRestrictedArea) {
  std::mt19937_64 random(14);
  Planner& planner = test::shared_planner();
  int searches = 0;
  int off_the_graph = 0;
  for (int draw = 0; searches < 16; ++draw) {
    ASSERT_LT(draw, 400);
    test::RandomSearch search(random);
    search.problem().colony.profile = Profile::kFast;
    search.problem().colony.generations = 60;
    const SearchProblem& problem = search.problem();
    if (planner.prepare(problem)) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    const Plan& plan = test::plan_of(planner);
    ASSERT_EQ(plan.paths.size(), problem.agents.size());
    double horizon_s = 0.0;
    for (std::size_t m = 0; m < plan.paths.size(); ++m) {
      const AgentPath& path = plan.paths[m];
      const GraphAgent& body = problem.agents[m].body;
      const auto blocked = static_cast<ClassSet>(obstacle_classes(problem.map.classes) |
                                                 restricted_classes(problem.map.classes, body.kind));
      ASSERT_EQ(path.waypoints[0], body.start);
      double length_m = 0.0;
      for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
        const Point a = path.waypoints[i - 1];
        const Point b = path.waypoints[i];
        ASSERT_TRUE(swept_disc_is_free(problem.map, blocked, a, b, body.footprint_radius_m)) << "leg " << i;
        ASSERT_FALSE(touches(body.restricted, a, b)) << "leg " << i;
        ASSERT_GT(distance_m(a, b), 1e-6) << "leg " << i << " leads nowhere";
        off_the_graph += joined(planner.graph(), static_cast<int>(m), a, b, i + 1 < path.waypoints.size()) ? 0 : 1;
        length_m += distance_m(a, b);
      }
      ASSERT_NEAR(path.length_m, length_m, kAgreement);
      ASSERT_NEAR(path.duration_s, length_m / problem.agents[m].speed_mps, kAgreement / problem.agents[m].speed_mps);
      horizon_s = std::max(horizon_s, path.duration_s);
    }
    ASSERT_EQ(plan.score.horizon_s, horizon_s);
  }
  EXPECT_GT(off_the_graph, 40);
}

TEST(Plan, OfAPlaceSeenFromTheStartIsToStayThere) {
  const test::DrawnMap map(3.0, 3.0, 0.25);
  SearchProblem problem;
  problem.map = map.view();
  problem.agents.resize(1);
  problem.agents[0].body.start = {1.5, 1.5};
  problem.colony.profile = Profile::kPaper;
  Planner& planner = test::shared_planner();
  ASSERT_FALSE(planner.prepare(problem));
  const Plan& plan = test::plan_of(planner);
  EXPECT_TRUE(plan.score.complete);
  EXPECT_EQ(plan.score.expected_time_s, 0.0);
  EXPECT_EQ(plan.score.horizon_s, 0.0);
  EXPECT_EQ(plan.paths[0].waypoints.size(), 1U);
  EXPECT_EQ(planner.progress().generation, 1);  // nothing is cheaper
}

TEST(Plan, OfTwoThatStartOnOnePlaceSendsThemApart) {
  const test::DrawnMap map(30.0, 8.0, 0.25);
  SearchProblem problem;
  problem.map = map.view();
  problem.cell_m = 0.5;
  problem.colony.generations = 20;
  problem.agents.resize(2);
  problem.agents[0].body.start = problem.agents[1].body.start = {15.0, 4.0};
  Planner& planner = test::shared_planner();
  ASSERT_FALSE(planner.prepare(problem));
  const Plan& plan = test::plan_of(planner);
  EXPECT_TRUE(plan.score.complete);
  for (const AgentPath& path : plan.paths) {
    EXPECT_GT(path.length_m, 10.0);
  }
}

TEST(Plan, OfAnAgentThatIsShutInLeavesTheRestToTheOther) {
  test::DrawnMap map(20.0, 8.0, 0.25);
  map.put(SemanticClass::kWater, 4.0, 0.0, 5.0, 8.0);  // it sees across, and cannot cross
  SearchProblem problem;
  problem.map = map.view();
  problem.cell_m = 0.5;
  problem.colony.generations = 3;
  problem.agents.resize(2);
  problem.agents[0].body.start = {2.0, 4.0};
  problem.agents[1].body.start = {18.0, 4.0};
  Planner& planner = test::shared_planner();
  ASSERT_FALSE(planner.prepare(problem));
  const Plan& plan = test::plan_of(planner);
  EXPECT_TRUE(plan.score.complete);
  for (const Point p : plan.paths[0].waypoints) {
    EXPECT_LT(p.x_m, 4.0);
  }
  for (const Point p : plan.paths[1].waypoints) {
    EXPECT_GT(p.x_m, 5.0);
  }
}

}  // namespace
}  // namespace ivo::planner
