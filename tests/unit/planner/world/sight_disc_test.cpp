#include "planner/world/sight_disc.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

Cells& cells_under(const test::DrawnMap& map, double cell_m) {
  static Cells cells;
  EXPECT_FALSE(cells.build(map.view(), cell_m));
  return cells;
}

// Row by row, against the rule tried on every cell. Returns the cells within.
int expect_the_rules_disc(const Cells& cells, Point from, double radius_m) {
  const SightDisc disc(cells, from, radius_m);
  int within = 0;
  for (int row = 0; row < cells.rows(); ++row) {
    const bool in_disc = row >= disc.first_row() && row <= disc.last_row();
    const SightDisc::Run run = in_disc ? disc.run(row) : SightDisc::Run{};
    for (int column = 0; column < cells.columns(); ++column) {
      const bool expected = within_radius(cells, from, column, row, radius_m);
      EXPECT_EQ(column >= run.first && column <= run.last, expected)
          << "column " << column << ", row " << row << " from " << from.x_m << ", " << from.y_m << ", R " << radius_m;
      within += expected ? 1 : 0;
    }
  }
  return within;
}

TEST(SightDisc, HoldsTheCellsWithinTheRadiusWhereverItLies) {
  std::mt19937_64 random(11);
  for (const double cell_m : {0.25, 0.5, 0.1, 0.3}) {
    const Cells& cells = cells_under(test::DrawnMap(6.0, 4.5, 0.1), cell_m);
    std::uniform_real_distribution<double> x(0.0, 6.0);
    std::uniform_real_distribution<double> y(0.0, 4.5);
    std::uniform_real_distribution<double> radius(0.0, 4.0);
    int within = 0;
    for (int i = 0; i < 500; ++i) {
      within += expect_the_rules_disc(cells, {x(random), y(random)}, i % 5 == 0 ? 20.0 : radius(random));
      ASSERT_FALSE(testing::Test::HasFailure());
    }
    EXPECT_GT(within, 1000);
  }
}

// Centres and corners as apex, and radii that end on a centre: where a rounding would show.
TEST(SightDisc, HoldsTheCellsOnTheCircle) {
  std::mt19937_64 random(12);
  for (const double cell_m : {0.25, 0.1, 0.3, 0.7}) {
    const Cells& cells = cells_under(test::DrawnMap(7.0, 5.6, 0.1), cell_m);
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<std::uint64_t>(count)); };
    for (int i = 0; i < 500; ++i) {
      const Point centre = cells.centre(below(cells.columns()), below(cells.rows()));
      const Point from = i % 2 == 0 ? centre : Point{below(cells.columns()) * cell_m, below(cells.rows()) * cell_m};
      const Point on = cells.centre(below(cells.columns()), below(cells.rows()));
      const double dx = on.x_m - from.x_m;
      const double dy = on.y_m - from.y_m;
      const double radius_m = i % 3 == 0 ? below(20) * cell_m : std::sqrt(dx * dx + dy * dy);
      expect_the_rules_disc(cells, from, radius_m);
      ASSERT_FALSE(testing::Test::HasFailure());
    }
  }
}

TEST(SightDisc, KeepsToTheRuleInCellsOfThreeTimesItsTolerance) {
  const Cells& cells = cells_under(test::DrawnMap(0.01, 0.01, 0.001), 1e-4);  // 1e-9 m^2 is a disc of 3.2e-5 m
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> place(0.0, 0.01);
  for (int i = 0; i < 100; ++i) {
    expect_the_rules_disc(cells, {place(random), place(random)}, i % 2 == 0 ? 0.0 : place(random) / 4);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

TEST(SightDisc, OfNoRadiusHoldsTheCellWhoseCentreItIs) {
  const Cells& cells = cells_under(test::DrawnMap(4.0, 4.0, 0.5), 0.5);
  EXPECT_EQ(expect_the_rules_disc(cells, {1.25, 2.75}, 0.0), 1);
  EXPECT_EQ(expect_the_rules_disc(cells, {1.3, 2.75}, 0.0), 0);
}

TEST(SightDisc, IsOpenOnlyWhereNothingNearHides) {
  test::DrawnMap map(20.0, 20.0, 0.5);
  map.put(SemanticClass::kWater, 2.0, 2.0, 4.0, 4.0).put(SemanticClass::kBuilding, 15.0, 15.0, 16.0, 16.0);
  const Cells& cells = cells_under(map, 0.5);
  EXPECT_TRUE(SightDisc(cells, {3.0, 3.0}, 2.5).open());  // water hides nothing
  EXPECT_FALSE(SightDisc(cells, {14.0, 14.0}, 2.5).open());
  EXPECT_FALSE(SightDisc(cells, {17.5, 15.5}, 2.5).open());
  EXPECT_TRUE(SightDisc(cells, {3.0, 15.5}, 2.5).open());
}

}  // namespace
}  // namespace ivo::planner
