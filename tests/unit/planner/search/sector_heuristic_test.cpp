// eta_MTS against a literal evaluation of its reading, cell by cell. Tiles of 8 x 8 cells stand for their cells: on an
// open map at 0.25 m cells and squares of 5 m, a weight differs by a few hundredths of the best one.
#include "planner/search/sector_heuristic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

class SectorHeuristicTest : public testing::Test {
 protected:
  static SectorHeuristic& sectors() {
    static const auto sectors = std::make_unique<SectorHeuristic>(world());
    return *sectors;
  }

  SectorHeuristicTest() { m1_.problem().graph.spacing_m = 5.0; }

  void open() {
    ASSERT_FALSE(test::shared_planner().prepare(m1_.problem()));
    sectors().open();
    start_ant();
    seen_.assign(index(world().cells.count()), false);
  }
  static void start_ant(int rows = 3) {
    sectors().start();
    while (!sectors().started()) {
      EXPECT_GT(sectors().start_tiles(rows), 0);
    }
  }
  static const World& world() { return test::shared_planner().world(); }

  void take_around(Point p, double radius_m) {
    const Cells& cells = world().cells;
    for (Cell c = 0; c < cells.count(); ++c) {
      const Point centre = cells.centre(c);
      if (!seen_[index(c)] && world().belief.mass[index(c)] > Mass{} &&
          std::hypot(centre.x_m - p.x_m, centre.y_m - p.y_m) < radius_m) {
        seen_[index(c)] = true;
        sectors().take(c);
      }
    }
  }

  static std::vector<double> weights(int agent, Node here, int beta, int tiles = std::numeric_limits<int>::max() / 2) {
    sectors().begin(agent, here);
    while (!sectors().done()) {
      EXPECT_GT(sectors().advance(tiles), 0);
    }
    std::vector<double> weights;
    for (Edge e = world().graph.first_edge(here); e < world().graph.end_edge(here); ++e) {
      weights.push_back(static_cast<double>(sectors().visibility(e, beta)) / static_cast<double>(visibility_from(1.0)));
    }
    return weights;
  }

  // The reading, literally: cells, angles and powers; over the best, as the planner has it.
  [[nodiscard]] std::vector<double> literal(int agent, Node here) const {
    const Graph& graph = world().graph;
    const Belief& belief = world().belief;
    const Point i = graph.position(here);
    std::vector<double> etas;
    for (Edge e = graph.first_edge(here); e < graph.end_edge(here); ++e) {
      const Point j = graph.position(graph.head(e));
      const double way = std::atan2(j.y_m - i.y_m, j.x_m - i.x_m);
      double sum = 0.0;
      for (Cell c = 0; c < world().cells.count(); ++c) {
        if (seen_[index(c)]) {
          continue;
        }
        const Point p = world().cells.centre(c);
        const double off = std::remainder(std::atan2(p.y_m - i.y_m, p.x_m - i.x_m) - way, 2.0 * M_PI);
        if (std::abs(off) <= M_PI / 8) {
          const Mass mass = belief.has_sub_priors ? belief.sub_mass[index(agent)][index(c)] : belief.mass[index(c)];
          sum += to_double(mass) * std::pow(0.8, std::hypot(p.x_m - j.x_m, p.y_m - j.y_m) / graph.spacing_m());
        }
      }
      etas.push_back(std::max(sum, 1e-6) / graph.length_m(e));
    }
    const double best = *std::max_element(etas.begin(), etas.end());
    for (double& eta : etas) {
      eta /= best;
    }
    return etas;
  }

  // Largest and mean difference over all nodes.
  void expect_near_literal(int agent, double most, double mean) const {
    double sum = 0.0;
    int count = 0;
    for (Node n = 0; n < world().graph.nodes(); ++n) {
      const std::vector<double> expected = literal(agent, n);
      const std::vector<double> actual = weights(agent, n, 1);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(actual[i], expected[i], most) << "node " << n << ", edge " << i;
        sum += std::abs(actual[i] - expected[i]);
        ++count;
      }
    }
    EXPECT_LT(sum / count, mean);
    EXPECT_GT(count, 1000);
  }

  test::M1 m1_{1};
  std::vector<bool> seen_;
};

TEST_F(SectorHeuristicTest, IsTheReadingOnAnOpenMapWithAUniformPrior) {
  open();
  expect_near_literal(0, 0.08, 0.02);
}

TEST_F(SectorHeuristicTest, IsTheReadingWhereMuchHasBeenSeen) {
  open();
  take_around({10.0, 10.0}, 9.0);
  take_around({30.0, 22.0}, 7.0);
  take_around({5.0, 33.0}, 5.0);
  expect_near_literal(0, 0.12, 0.03);
}

TEST_F(SectorHeuristicTest, IsTheReadingOnAnAgentsOwnSubPrior) {
  const std::vector<GaussianComponent> gaussians = {{{12.0, 14.0}, 5.0, 1.0}, {{30.0, 28.0}, 5.0, 1.0}};
  const std::vector<std::int8_t> dealt = {0, 1};
  m1_.problem().prior = std::span<const GaussianComponent>(gaussians);
  m1_.problem().sub_priors = DealtComponents{dealt};
  open();
  take_around({12.0, 10.0}, 4.0);
  expect_near_literal(0, 0.15, 0.03);
  expect_near_literal(1, 0.15, 0.03);
}

TEST_F(SectorHeuristicTest, IsTheSameHoweverTheTilesAreSliced) {
  open();
  take_around({10.0, 10.0}, 9.0);
  for (const int tiles : {1, 7, 100}) {
    EXPECT_EQ(weights(0, 20, 6, tiles), weights(0, 20, 6));
  }
}

TEST_F(SectorHeuristicTest, TakesAnyWholePower) {
  open();
  const std::vector<double> once = weights(0, 5, 1);
  const std::vector<double> sixth = weights(0, 5, 6);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_NEAR(sixth[i], std::pow(once[i], 6), kFixedPoint ? 1e-4 : 1e-12);
  }
  for (const double none : weights(0, 5, 0)) {
    EXPECT_EQ(none, 1.0);
  }
}

TEST_F(SectorHeuristicTest, FallsToTheInverseLengthWhereNothingIsLeft) {
  open();
  take_around({20.0, 20.0}, 100.0);
  const Graph& graph = world().graph;
  const std::vector<double> left = weights(0, 30, 1);
  double shortest_m = 1e9;
  for (Edge e = graph.first_edge(30); e < graph.end_edge(30); ++e) {
    shortest_m = std::min(shortest_m, graph.length_m(e));
  }
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_NEAR(left[i], shortest_m / graph.length_m(graph.first_edge(30) + static_cast<Edge>(i)), 0.01);
  }
}

TEST_F(SectorHeuristicTest, ForgetsWithANewAntWhatTheLastHasSeen) {
  open();
  const std::vector<double> whole = weights(0, 9, 1);
  take_around({20.0, 20.0}, 12.0);
  EXPECT_NE(weights(0, 9, 1), whole);
  start_ant();
  EXPECT_EQ(weights(0, 9, 1), whole);
}

}  // namespace
}  // namespace ivo::planner
