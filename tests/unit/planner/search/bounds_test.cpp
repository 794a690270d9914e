#include "planner/search/bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using enum SemanticClass;

constexpr double kUnseen = 0.014;

Bounds bounds_of(const SearchProblem& problem, double unseen_mass = kUnseen) {
  Planner& planner = test::shared_planner();
  EXPECT_EQ(planner.prepare(problem).code, RefusalCode::kNone);
  return planner.bounds(unseen_mass);
}

const std::vector<GaussianComponent> kTwoGaussians = {{{12.0, 12.0}, 4.0, 1.0}, {{30.0, 28.0}, 4.0, 1.0}};

TEST(Bounds, OnM1WithAUniformPriorAreTheModelsFigures) {
  test::M1 m1(1);
  const Bounds bounds = bounds_of(m1.problem());
  EXPECT_NEAR(bounds.bound_s(), 76.1, 0.05);
  EXPECT_NEAR(bounds.bound_strict_s(), 70.5, 0.1);
  EXPECT_NEAR(bounds.area.nominal_s, 76.1, 0.05);
  EXPECT_NEAR(bounds.area.strict_s, 70.5, 0.1);
}

TEST(Bounds, AreStricterInSmallerCells) {
  if (limits::kCells < 640 * 640) {
    GTEST_SKIP() << "M1 in cells of 0.0625 m is over this profile's capacity";
  }
  // By the table alone: the planner's own table of sights would be over its capacity.
  static Cells cells;
  static Belief belief;
  static BoundTable table;
  test::M1 m1(1);
  const SearchProblem& problem = m1.problem();
  ASSERT_FALSE(cells.build(problem.map, 0.0625));
  belief.mass_cell_count = cells.count();
  std::iota(belief.mass_cells.begin(), belief.mass_cells.begin() + cells.count(), 0);
  std::fill_n(belief.mass.begin(), cells.count(), Mass(1.0 / cells.count()));
  std::vector<BoundAgent> agents;
  for (const SearchAgent& agent : problem.agents) {
    agents.push_back({{agent.body.start, agent.body.kind, 0.3}, agent.speed_mps, agent.sight_radius_m});
  }
  table.build(problem.map, cells, belief, agents);
  EXPECT_NEAR(table.at(kUnseen).area.nominal_s, 76.1, 0.05);
  EXPECT_NEAR(table.at(kUnseen).area.strict_s, 74.5, 0.2);
}

// The closed form: area swept, the same density everywhere.
TEST(Bounds, OfAreaOnAUniformPriorAreTheClosedForm) {
  test::M1 m1(1);
  for (const std::size_t agents : {std::size_t{1}, std::size_t{2}}) {
    m1.problem().agents.resize(agents);
    for (const double speed_mps : {0.4, 2.5}) {
      m1.problem().agents[0].speed_mps = speed_mps;
      double base = 0.0;
      double rate = 0.0;
      for (const SearchAgent& agent : m1.problem().agents) {
        base += 3.14159265358979 * 2.5 * 2.5 / 1600.0;
        rate += 2.0 * 2.5 * agent.speed_mps / 1600.0;
      }
      (void)bounds_of(m1.problem());
      for (const double unseen : {0.0, 0.014, 0.2}) {
        const double end_s = (1.0 - unseen - base) / rate;
        const double expected = end_s * (1.0 - base + unseen) / 2.0;
        const double bound = test::shared_planner().bounds(unseen).area.nominal_s;
        EXPECT_LE(bound, expected);
        EXPECT_NEAR(bound, expected, 1e-3 * expected);
      }
    }
  }
}

TEST(Bounds, OfReachAreMuchHigherOnAPeakedPriorFarFromTheStarts) {
  test::M1 m1(1);
  m1.problem().prior = std::span<const GaussianComponent>(kTwoGaussians);
  const Bounds bounds = bounds_of(m1.problem());
  EXPECT_NEAR(bounds.bound_s(), 23.15, 0.1);
  EXPECT_EQ(bounds.bound_s(), bounds.reach.nominal_s);
  EXPECT_GT(bounds.reach.nominal_s, 1.4 * bounds.area.nominal_s);
  EXPECT_GT(bounds.reach.strict_s, 1.4 * bounds.area.strict_s);
}

TEST(Bounds, FallWithTheMassThatMayStayUnseen) {
  test::M1 m1(1);
  m1.problem().prior = std::span<const GaussianComponent>(kTwoGaussians);
  Bounds last = bounds_of(m1.problem(), 0.0);
  for (const double unseen : {0.001, 0.014, 0.1, 0.5, 0.9}) {
    const Bounds bounds = test::shared_planner().bounds(unseen);
    EXPECT_LT(bounds.area.nominal_s, last.area.nominal_s);
    EXPECT_LT(bounds.area.strict_s, last.area.strict_s);
    EXPECT_LT(bounds.reach.nominal_s, last.reach.nominal_s);
    EXPECT_LT(bounds.reach.strict_s, last.reach.strict_s);
    last = bounds;
  }
  EXPECT_EQ(test::shared_planner().bounds(1.0).bound_s(), 0.0);
}

TEST(Bounds, FallWithASecondAgentAndWithSpeed) {
  test::M1 m1(1);
  m1.problem().prior = std::span<const GaussianComponent>(kTwoGaussians);
  const Bounds two = bounds_of(m1.problem());
  m1.problem().agents[1].speed_mps = 2.0;
  const Bounds faster = bounds_of(m1.problem());
  m1.problem().agents.resize(1);
  const Bounds one = bounds_of(m1.problem());
  EXPECT_LT(faster.area.nominal_s, two.area.nominal_s);
  EXPECT_LT(faster.reach.nominal_s, two.reach.nominal_s);
  EXPECT_GT(one.area.nominal_s, 1.5 * two.area.nominal_s);
  EXPECT_GT(one.reach.nominal_s, 1.5 * two.reach.nominal_s);
}

// A prior of one cell is found at the earliest when its reach has shrunk the distance to R.
TEST(Bounds, OfAPriorOnOneCellAreTheWayToIt) {
  test::M1 m1(1);
  std::vector<std::uint16_t> values(160 * 160, 0);
  values[80 * 160 + 80] = 1;  // centre (20.125, 20.125)
  m1.problem().prior = GreyView{values, 160, 160, 0.25};
  const double way_s = std::hypot(20.125 - 1.75, 20.125 - 1.75) - 2.5;
  const Bounds bounds = bounds_of(m1.problem(), 0.0);
  EXPECT_EQ(bounds.area.nominal_s, 0.0);
  EXPECT_LE(bounds.reach.nominal_s, way_s);
  EXPECT_NEAR(bounds.reach.nominal_s, way_s, 0.01);
  EXPECT_EQ(bounds.reach.strict_s, bounds.reach.nominal_s);
  m1.problem().agents[0].speed_mps = 0.5;  // the other is nearer in time: 19.125 m and 18.375 m
  EXPECT_NEAR(bounds_of(m1.problem(), 0.0).reach.nominal_s, std::hypot(39.25 - 20.125, 18.375) - 2.5, 0.01);
  m1.problem().agents[1].speed_mps = 0.25;
  EXPECT_NEAR(bounds_of(m1.problem(), 0.0).reach.nominal_s, way_s / 0.5, 0.02);
}

TEST(Bounds, AreNoneWhenEverythingIsInSightOfTheStarts) {
  test::M1 m1(1);
  std::vector<std::uint16_t> values(16 * 16, 0);
  values[0] = 1;  // 2.5 x 2.5 m around the first start
  m1.problem().prior = GreyView{values, 16, 16, 2.5};
  EXPECT_EQ(bounds_of(m1.problem(), 0.0).bound_s(), 0.0);
}

TEST(Bounds, OfReachRiseWithAWallThatLengthensTheWay) {
  test::DrawnMap open(30.0, 20.0, 0.25);
  test::DrawnMap walled = open;
  walled.put(kWall, 15.0, 3.0, 15.5, 20.0);  // a gap of 3 m at the bottom
  const std::vector<GaussianComponent> behind = {{{22.0, 16.0}, 1.5, 1.0}};
  SearchProblem problem;
  problem.prior = std::span<const GaussianComponent>(behind);
  problem.agents.resize(1);
  problem.agents[0].body.start = {8.0, 16.0};
  problem.map = open.view();
  const Bounds without = bounds_of(problem);
  problem.map = walled.view();
  const Bounds with = bounds_of(problem);
  // 14 m become 2 sqrt(7^2 + 13^2) = 29.5 m at 0.5 m/s; octile distance tells at least 1/1.0824 of it.
  EXPECT_NEAR(with.area.nominal_s, without.area.nominal_s, 1e-3);
  EXPECT_GT(with.reach.nominal_s, without.reach.nominal_s + 0.8 * 15.5 / 0.5);
  EXPECT_GT(with.reach.strict_s, without.reach.strict_s + 0.8 * 15.5 / 0.5);
}

TEST(Bounds, KnowOnlyTheClassesThatBlockTheAgent) {
  test::DrawnMap map(30.0, 20.0, 0.25);
  map.put(kStairs, 15.0, 3.0, 15.5, 20.0);
  const std::vector<GaussianComponent> behind = {{{22.0, 16.0}, 1.5, 1.0}};
  SearchProblem problem;
  problem.map = map.view();
  problem.prior = std::span<const GaussianComponent>(behind);
  problem.agents.resize(1);
  problem.agents[0].body.start = {8.0, 16.0};
  problem.agents[0].body.kind = AgentKind::kPerson;
  const double of_person = bounds_of(problem).reach.nominal_s;
  problem.agents[0].body.kind = AgentKind::kRobot;
  EXPECT_GT(bounds_of(problem).reach.nominal_s, of_person + 20.0);
}

}  // namespace
}  // namespace ivo::planner
