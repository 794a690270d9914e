#include "planner/search/trails.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

constexpr double kRho = 0.002;

// In fixed point trails are kept times rho, in whole units (roulette.hpp).
constexpr double kTrailUnit = kFixedPoint ? 0x1p-30 : 1.0;
constexpr double kAttractionUnit = kFixedPoint ? 0x1p-38 : 1.0;
Trail trail(double value) { return static_cast<Trail>(value / kTrailUnit); }
double value_of(Trail tau) { return static_cast<double>(tau) * kTrailUnit; }
double attraction_of(Weight weight) { return static_cast<double>(weight) * kAttractionUnit; }
// The model's tau, whose tau_max is 1 / (rho C).
double tau_of(Trail tau) { return value_of(tau) / (kFixedPoint ? kRho : 1.0); }
constexpr double kExact = kFixedPoint ? 1e-4 : 1e-12;

// Agent 0 has the whole of a map of 14 x 14 m; agent 1 is walled into a room of one node.
class TrailsTest : public testing::Test {
 protected:
  TrailsTest() {
    test::DrawnMap map(14.0, 14.0, 0.25);
    map.put(SemanticClass::kWall, 10.5, 10.0, 14.0, 10.5).put(SemanticClass::kWall, 10.0, 10.0, 10.5, 14.0);
    GraphAgents agents;
    agents.resize(2);
    agents[0].start = {1.75, 1.75};
    agents[1].start = {12.25, 12.25};
    EXPECT_FALSE(graph_.build(map.view(), {}, agents));
    trails_.start(graph_, kRho, 6);
  }

  [[nodiscard]] Edge edge(Node from, int nth) const { return graph_.first_edge(from) + nth; }

  static Graph graph_;
  static Trails trails_;
};
Graph TrailsTest::graph_;
Trails TrailsTest::trails_;

TEST_F(TrailsTest, AreAllEqualAtFirst) {
  for (Edge e = 0; e < graph_.edges(); ++e) {
    ASSERT_EQ(trails_.tau(0, e), trails_.tau(0, 0));
    ASSERT_EQ(trails_.tau(1, e), trails_.tau(0, 0));
  }
}

TEST_F(TrailsTest, DrawByTheSixthPowerOfTheInverseLength) {
  for (Edge e = 0; e < graph_.edges(); ++e) {
    const double eta = std::pow(3.5 / graph_.length_m(e), 6.0);
    // In fixed point half a unit of 2^-18, which is a hundredth of the longest edge's.
    ASSERT_NEAR(attraction_of(trails_.attraction(0, e)) / (value_of(trails_.tau(0, e)) * eta), 1.0,
                kFixedPoint ? 0x1p-18 / eta : 1e-12);
  }
  trails_.deposit(0, 0, trail(1.0));
  EXPECT_NEAR(attraction_of(trails_.attraction(0, 0)) / attraction_of(trails_.attraction(1, 0)), 2.0, kExact);
}

TEST_F(TrailsTest, TakeAnyWholePowerOfTheHeuristic) {
  trails_.start(graph_, kRho, 0);
  EXPECT_EQ(attraction_of(trails_.attraction(0, 0)), value_of(trails_.tau(0, 0)));
  trails_.start(graph_, kRho, 2);
  EXPECT_NEAR(attraction_of(trails_.attraction(0, 3)), std::pow(3.5 / graph_.length_m(3), 2.0), kExact);
}

TEST_F(TrailsTest, LieBetweenTheLimitsOfTheModel) {
  trails_.set_limits(Mass(105.0));
  EXPECT_NEAR(tau_of(trails_.tau_max()) * kRho * 105.0, 1.0, kFixedPoint ? 1e-6 : 1e-15);
  const double n = graph_.nodes_reached_by(0);
  const double a = std::max(2.0, graph_.edges_open_to(0) / n / 2.0);
  const double s = std::pow(0.05, 1.0 / n);
  EXPECT_GT(n, 10);
  EXPECT_NEAR(tau_of(trails_.tau_min(0)), tau_of(trails_.tau_max()) * (1.0 - s) / ((a - 1.0) * s),
              kFixedPoint ? 2 * kTrailUnit / kRho : 1e-12);
  EXPECT_LT(trails_.tau_min(0), trails_.tau_max());
}

TEST_F(TrailsTest, HaveOneLimitWhereAnAgentHasNoChoice) {
  trails_.set_limits(Mass(50.0));
  EXPECT_EQ(graph_.nodes_reached_by(1), 1);
  EXPECT_EQ(trails_.tau_min(1), trails_.tau_max());  // (1 - 0.05) / 0.05 is above 1
}

TEST_F(TrailsTest, EvaporateInThePartThatIsNamedOnly) {
  trails_.set_limits(Mass(100.0));
  trails_.raise_to_max(0, 0, graph_.edges());
  trails_.evaporate(0, 10, 5);
  for (Edge e = 0; e < graph_.edges(); ++e) {
    ASSERT_NEAR(value_of(trails_.tau(0, e)), value_of(trails_.tau_max()) * (e >= 10 && e < 15 ? 1.0 - kRho : 1.0),
                kFixedPoint ? 2 * kTrailUnit : 0.0)
        << e;
  }
  EXPECT_EQ(value_of(trails_.tau(1, 12)), 1.0);
}

TEST_F(TrailsTest, ComeBackBetweenTheLimitsWhenClamped) {
  trails_.set_limits(Mass(100.0));
  trails_.raise_to_max(0, 0, graph_.edges());
  trails_.deposit(0, 4, trail(0.01));
  for (int i = 0; i < 20'000; ++i) {
    trails_.evaporate(0, 5, 1);
  }
  trails_.clamp(0, 0, graph_.edges());
  EXPECT_EQ(trails_.tau(0, 4), trails_.tau_max());
  EXPECT_EQ(trails_.tau(0, 5), trails_.tau_min(0));
}

TEST_F(TrailsTest, OfEachAgentAreItsOwn) {
  trails_.deposit(1, 7, trail(0.5));
  EXPECT_EQ(trails_.tau(1, 7), trails_.tau(0, 7) + trail(0.5));
}

TEST_F(TrailsTest, DrawNoAntForeverToAStartOnTheSamePlace) {
  GraphAgents agents;
  agents.resize(2);
  agents[0].start = agents[1].start = {1.75, 1.75};
  ASSERT_FALSE(graph_.build(test::DrawnMap(14.0, 14.0, 0.25).view(), {}, agents));
  trails_.start(graph_, kRho, 6);
  const double between = attraction_of(trails_.attraction(0, graph_.find(0, 1)));
  EXPECT_TRUE(std::isfinite(between));
  EXPECT_GT(between, 1.0);
}

}  // namespace
}  // namespace ivo::planner
