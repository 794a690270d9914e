// Against plans and against ways: what the bounds claim, on random searches.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "planner/search/edge_events.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"
#include "tests/support/swath_cells.hpp"

namespace ivo::planner {
namespace {

constexpr double kRounding_s = 1e-6;

TEST(Bounds, NoPlanOfRandomSearchesIsBetter) {
  std::mt19937_64 random(71);
  Planner& planner = test::shared_planner();
  static Plan plan;
  int plans = 0;
  int complete = 0;
  double least_gap = 1e9;
  for (int draw = 0; plans < 300; ++draw) {
    ASSERT_LT(draw, 3000);
    test::RandomSearch search(random);
    if (planner.prepare(search.problem())) {
      continue;
    }
    SCOPED_TRACE("draw " + std::to_string(draw));
    const auto judge = [&](const Plan& judged) {
      ++plans;
      complete += judged.score.complete ? 1 : 0;
      const double cost_s = judged.score.expected_time_continuous_s;
      const Bounds bounds = planner.bounds(judged.score.unseen_mass);
      EXPECT_GE(cost_s + kRounding_s, bounds.area.strict_s);
      EXPECT_GE(cost_s + kRounding_s, bounds.reach.strict_s);
      EXPECT_LE(bounds.area.strict_s, bounds.area.nominal_s + kRounding_s);
      EXPECT_LE(bounds.reach.strict_s, bounds.reach.nominal_s + kRounding_s);
      EXPECT_LE(bounds.area.nominal_s, bounds.reach.nominal_s + kRounding_s);
      EXPECT_LE(bounds.area.strict_s, bounds.reach.strict_s + kRounding_s);
      if (bounds.reach.strict_s > 1.0) {
        least_gap = std::min(least_gap, cost_s / bounds.reach.strict_s - 1.0);
      }
    };
    while (!planner.step({50}).has_plan) {
    }
    planner.best_plan(plan);
    judge(plan);
    judge(test::plan_of(planner));
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(complete, 100);
  EXPECT_LT(least_gap, 0.5);  // bounds that say nothing would pass above
}

// Walls of every thickness and direction between small rooms, pixels finer than the cells, a dense graph.
class WalledSearch {
 public:
  explicit WalledSearch(std::mt19937_64& random)
      : random_(random), map_(between(8.0, 14.0), between(7.0, 10.0), chance(0.5) ? 0.05 : 0.1) {
    for (int i = 0; i < 7; ++i) {
      const Point p{between(0.0, 12.0), between(0.0, 9.0)};
      const double thick_m = between(0.1, 1.0);
      const double long_m = between(1.0, 6.0);
      const bool upright = chance(0.5);
      map_.put(chance(0.5) ? SemanticClass::kWall : SemanticClass::kWater, p.x_m, p.y_m,
               p.x_m + (upright ? thick_m : long_m), p.y_m + (upright ? long_m : thick_m));
    }
    for (double x = between(1.0, 3.0), y = between(1.0, 3.0); x < 8.0; x += 0.1, y += 0.08) {  // a diagonal one
      map_.put(SemanticClass::kBuilding, x, y, x + 0.3, y + 0.2);
    }
    constexpr std::array<double, 4> kCells_m = {0.1, 0.2, 0.25, 0.4};
    problem_.map = map_.view();
    problem_.cell_m = kCells_m[random_() % kCells_m.size()];
    problem_.graph = {.spacing_m = between(0.6, 1.0), .clearance_m = 0.2};
    problem_.agents.resize(1 + random_() % 2);
    for (SearchAgent& agent : problem_.agents) {
      agent.body.start = {between(0.0, 8.0), between(0.0, 7.0)};
      agent.body.footprint_radius_m = between(0.15, 0.45);
      agent.sight_radius_m = between(0.4, 1.5);
      agent.speed_mps = between(0.3, 1.5);
    }
  }
  WalledSearch(const WalledSearch&) = delete;
  WalledSearch& operator=(const WalledSearch&) = delete;

  [[nodiscard]] const SearchProblem& problem() const { return problem_; }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double p) { return between(0.0, 1.0) < p; }

  std::mt19937_64& random_;
  test::DrawnMap map_;
  SearchProblem problem_;
};

// The least time at which each cell is seen by moves along the graph: by the shortest way to a node, and on along each
// edge from there.
std::vector<double> seen_s(const Planner& planner, const SearchProblem& problem) {
  static JumpSearch shortest;
  const Graph& graph = planner.graph();
  static EdgeEvents events(planner.cells(), planner.graph(), planner.sight());  // of the shared planner
  events.clear();
  std::vector<double> seen(index(planner.cells().count()), 1e30);
  for (int m = 0; m < graph.agents(); ++m) {
    const auto see = [&](Cell c, double way_m) {
      seen[index(c)] = std::min(seen[index(c)], way_m / problem.agents[index(m)].speed_mps);
    };
    std::vector<double> way_m(index(graph.nodes()), 1e30);
    shortest.open(graph);
    shortest.start(m, m);
    for (Node n = shortest.settle_next(); n >= 0; n = shortest.settle_next()) {
      const Edge by = shortest.edge_to(n);
      way_m[index(n)] = by < 0 ? 0.0 : way_m[index(shortest.before(n))] + graph.length_m(by);
      test::for_each_cell(planner.cells(), planner.sight(), planner.sight().from_node(m, n),
                          [&](Cell c, const Swath&) { see(c, way_m[index(n)]); });
    }
    for (Node n = 0; n < graph.nodes(); ++n) {
      for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
        if (in(graph.open_to(e), m)) {
          (void)events.prepare(m, n, e, std::numeric_limits<int>::max());
          for (const SightEvent event : events.along(m, e)) {
            see(event.cell(), way_m[index(n)] + graph.length_m(e) * event.point() / planner.sight().points(e));
          }
        }
      }
    }
  }
  return seen;
}

double straight_s(const Planner& planner, const SearchProblem& problem, Cell c) {
  double least_s = 1e30;
  for (const SearchAgent& agent : problem.agents) {
    const Point p = planner.cells().centre(c);
    const double way_m = std::hypot(p.x_m - agent.body.start.x_m, p.y_m - agent.body.start.y_m);
    least_s = std::min(least_s, std::max(0.0, way_m - agent.sight_radius_m) / agent.speed_mps);
  }
  return least_s;
}

TEST(Bounds, NothingIsSeenBeforeItsTimeOfReach) {
  std::mt19937_64 random(72);
  Planner& planner = test::shared_planner();
  int searches = 0;
  double ratios = 0.0;  // reach over the graph's time, where the way around is much longer
  int around = 0;
  for (int draw = 0; searches < 25; ++draw) {
    ASSERT_LT(draw, 1500);
    const WalledSearch search(random);
    if (planner.prepare(search.problem())) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    const std::vector<double> seen = seen_s(planner, search.problem());
    for (const Cell c : planner.belief().cells_with_mass()) {
      const double reach_s = planner.bound_table().reach_s(c);
      ASSERT_LE(reach_s, seen[index(c)] + kRounding_s) << "cell " << c;
      if (seen[index(c)] > 2.0 * straight_s(planner, search.problem(), c) + 5.0) {
        ++around;
        ratios += reach_s / seen[index(c)];
      }
    }
  }
  EXPECT_GT(around, 300);
  EXPECT_GT(ratios / around, 0.5);
}

}  // namespace
}  // namespace ivo::planner
