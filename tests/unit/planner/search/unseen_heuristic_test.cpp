// The unseen mass of an edge's parts against a count cell by cell, from their sight points.
#include "planner/search/unseen_heuristic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "planner/search/sector_heuristic.hpp"
#include "planner/world/visibility.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"
#include "tests/support/star.hpp"

namespace ivo::planner {
namespace {

constexpr double kSameWorth = kFixedPoint ? 12 * 0x1p-16 : 1e-9;  // six factors of 16 bits, rounded as they come

// What each part of the way, from its first sight point to its last, shows of what is unseen.
double slow_mass(const World& world, int agent, Node tail, Edge e, const SeenMap& seen) {
  const Belief& belief = world.belief;
  const SightView view = world.sight.along_edge(agent, e);
  Point from = world.graph.position(tail);
  Point to = world.graph.position(world.graph.head(e));
  if (view.reversed) {
    std::swap(from, to);
  }
  std::set<std::pair<int, int>> parts;  // a part that is wider than a swath has several
  for (const Swath& swath : view.swaths) {
    parts.insert({swath.first_point, swath.last_point});
  }
  double sum = 0.0;
  for (const auto& [first, last] : parts) {
    std::set<Cell> shown;
    for (int k = first; k <= last; ++k) {
      for_each_seen(world.cells, sight_point(from, to, k, world.sight.points(e)), world.sight.radius_m(agent),
                    [&](Cell c) { shown.insert(c); });
    }
    for (const Cell c : shown) {
      if (!seen.test(world.cells.column(c), world.cells.row(c))) {
        sum += to_double(belief.has_sub_priors ? belief.sub_mass[index(agent)][index(c)] : belief.mass[index(c)]);
      }
    }
  }
  return sum;
}

// In fixed point a length counts in whole ticks.
double counted_m(double length_m) { return kFixedPoint ? std::floor(length_m * 64.0) / 64.0 : length_m; }

// What some moves of all agents have shown; the nodes where they are then.
std::vector<Node> wander(const World& world, int moves, std::mt19937_64& random, SeenMap& seen) {
  std::vector<Node> at;
  for (int agent = 0; agent < world.graph.agents(); ++agent) {
    at.push_back(agent);
    for (int i = 0; i < moves; ++i) {
      Node& here = at.back();
      const auto edges = static_cast<std::uint64_t>(world.graph.end_edge(here) - world.graph.first_edge(here));
      const Edge e = edges == 0 ? 0 : world.graph.first_edge(here) + static_cast<Edge>(random() % edges);
      if (edges == 0 || !in(world.graph.open_to(e), agent)) {
        continue;
      }
      for (const Swath& swath : world.sight.along_edge(agent, e).swaths) {
        seen.look(swath, world.sight.words(swath), [](int, std::uint64_t) {});
      }
      here = world.graph.head(e);
    }
  }
  return at;
}

struct Looks {
  int searches = 0;
  int of_several_agents = 0;
  int with_sub_priors = 0;
  int alike = 0;
  int edges = 0;
  int showing_nothing = 0;
};

void expect_the_slow_count(const World& world, int agent, Node here, const SeenMap& seen, std::mt19937_64& random,
                           Looks& tally) {
  static const auto heuristic = std::make_unique<UnseenHeuristic>(test::shared_planner().world());
  std::vector<bool> wanted;
  std::vector<double> etas;
  double best = 0.0;
  for (Edge e = world.graph.first_edge(here); e < world.graph.end_edge(here); ++e) {
    wanted.push_back(in(world.graph.open_to(e), agent) && random() % 4 != 0);
    etas.push_back(wanted.back() ? slow_mass(world, agent, here, e, seen) / counted_m(world.graph.length_m(e)) : 0.0);
    best = std::max(best, etas.back());
  }
  for (const int rows : {1, 7, 100'000}) {
    heuristic->begin(agent, here);
    while (!heuristic->done()) {
      ASSERT_GT(heuristic->advance(seen, rows, [&](Edge e) { return wanted[index(e - world.graph.first_edge(here))]; }),
                0);
    }
    for (std::size_t i = 0; i < etas.size(); ++i) {
      const Edge e = world.graph.first_edge(here) + static_cast<Edge>(i);
      for (const int beta : {0, 1, 6}) {
        const double expected = etas[i] > 0.0 ? std::pow(etas[i] / best, beta) : 0.0;
        const double actual =
            static_cast<double>(heuristic->visibility(e, beta)) / static_cast<double>(visibility_from(1.0));
        ASSERT_NEAR(actual, expected, kSameWorth) << "edge " << i << ", beta " << beta;
        ASSERT_EQ(actual > 0.0, expected > 0.0) << "edge " << i << ", beta " << beta;
      }
    }
  }
  tally.edges += static_cast<int>(etas.size());
  tally.showing_nothing += static_cast<int>(std::count(etas.begin(), etas.end(), 0.0));
}

TEST(UnseenHeuristic, IsTheUnseenMassOfTheWaysPartsOverItsLength) {
  std::mt19937_64 random(91);
  const auto seen = std::make_unique<SeenMap>();
  Looks tally;
  for (int draw = 0; tally.searches < 60; ++draw) {
    ASSERT_LT(draw, 600);
    test::RandomSearch search(random);
    if (test::shared_planner().prepare(search.problem())) {
      continue;
    }
    SCOPED_TRACE("draw " + std::to_string(draw));
    const World& world = test::shared_planner().world();
    ++tally.searches;
    tally.of_several_agents += world.graph.agents() > 1 ? 1 : 0;
    tally.with_sub_priors += world.belief.has_sub_priors ? 1 : 0;
    tally.alike += !world.belief.has_sub_priors && world.belief.alike > Mass{} ? 1 : 0;
    seen->copy(world.belief.without_mass);
    const std::vector<Node> at = wander(world, draw % 5, random, *seen);
    for (std::size_t m = 0; m < at.size(); ++m) {
      expect_the_slow_count(world, static_cast<int>(m), at[m], *seen, random, tally);
      ASSERT_FALSE(testing::Test::HasFatalFailure()) << "agent " << m;
    }
  }
  EXPECT_GT(tally.of_several_agents, 30);
  EXPECT_GT(tally.with_sub_priors, 10);
  EXPECT_GT(tally.alike, 3);
  EXPECT_GT(tally.edges, 1'500);
  EXPECT_GT(tally.showing_nothing, 50);
}

TEST(UnseenHeuristic, SaysTheUnseenMassItself) {
  std::mt19937_64 random(92);
  const auto seen = std::make_unique<SeenMap>();
  int compared = 0;
  for (int draw = 0; compared < 300; ++draw) {
    ASSERT_LT(draw, 600);
    test::RandomSearch search(random);
    if (test::shared_planner().prepare(search.problem())) {
      continue;
    }
    const World& world = test::shared_planner().world();
    seen->copy(world.belief.without_mass);
    const std::vector<Node> at = wander(world, draw % 3, random, *seen);
    for (std::size_t m = 0; m < at.size(); ++m) {
      const auto agent = static_cast<int>(m);
      for (Edge e = world.graph.first_edge(at[m]); e < world.graph.end_edge(at[m]); ++e) {
        if (in(world.graph.open_to(e), agent)) {
          ++compared;
          UnseenMass unseen(world);
          unseen.begin(agent, world.sight.along_edge(agent, e));
          while (!unseen.done()) {
            (void)unseen.advance(*seen, 1 + compared % 40);
          }
          // Sums of masses are exact in both builds.
          ASSERT_EQ(to_double(unseen.mass()), slow_mass(world, agent, at[m], e, *seen));
        }
      }
    }
  }
}

// The last neighbour of a node with as many as there may be is weighed as the others are; so it is by sectors.
TEST(UnseenHeuristic, WeighsEveryNeighbour) {
  const test::DrawnMap map(40.0, 40.0, 0.5);
  const test::Star star({20.0, 20.0}, limits::kNeighbours, 15.0);
  const GraphTable table = star.table();
  SearchProblem problem;
  problem.map = map.view();
  problem.cell_m = 0.5;
  problem.graph_table = &table;
  problem.agents.resize(1);
  problem.agents[0].body.start = {20.0, 20.0};
  ASSERT_FALSE(test::shared_planner().prepare(problem));
  const World& world = test::shared_planner().world();
  ASSERT_EQ(world.graph.end_edge(0), limits::kNeighbours);
  const auto unseen = std::make_unique<UnseenHeuristic>(world);
  unseen->begin(0, 0);
  while (!unseen->done()) {
    (void)unseen->advance(world.belief.without_mass, 1000, [](Edge) { return true; });
  }
  const auto sectors = std::make_unique<SectorHeuristic>(world);
  sectors->open();
  sectors->start();
  while (!sectors->started()) {
    (void)sectors->start_tiles(1000);
  }
  (void)sectors->begin(0, 0);
  while (!sectors->done()) {
    (void)sectors->advance(1000);
  }
  for (Edge e = 0; e < limits::kNeighbours; ++e) {
    EXPECT_GT(static_cast<double>(unseen->visibility(e, 1)), 0.5 * static_cast<double>(visibility_from(1.0))) << e;
    EXPECT_GT(static_cast<double>(sectors->visibility(e, 1)), 0.5 * static_cast<double>(visibility_from(1.0))) << e;
  }
}

}  // namespace
}  // namespace ivo::planner
