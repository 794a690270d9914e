#include "planner/world/visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

constexpr int kParts = 16;  // positions on sixteenths of a cell are exact, and often on lines and corners

struct Step {
  int column;
  int row;
};

// The cells between a position and a cell's centre: all crossings of grid lines in order, as fractions of whole
// numbers.
std::vector<Step> slow_walk(int x, int y, int target_column, int target_row) {
  struct Crossing {
    std::int64_t numerator;
    std::int64_t denominator;
    bool in_y;
  };
  const int to_x = target_column * kParts + kParts / 2;
  const int to_y = target_row * kParts + kParts / 2;
  int column = x / kParts;
  int row = y / kParts;
  std::vector<Crossing> crossings;
  for (int c = std::min(column, target_column) + 1; c <= std::max(column, target_column); ++c) {
    crossings.push_back({std::abs(c * kParts - x), std::abs(to_x - x), false});
  }
  for (int r = std::min(row, target_row) + 1; r <= std::max(row, target_row); ++r) {
    crossings.push_back({std::abs(r * kParts - y), std::abs(to_y - y), true});
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    const std::int64_t left = a.numerator * b.denominator;
    const std::int64_t right = b.numerator * a.denominator;
    return left != right ? left < right : a.in_y && !b.in_y;
  });
  std::vector<Step> between;
  for (const Crossing& crossing : crossings) {
    row += crossing.in_y ? (target_row > row ? 1 : -1) : 0;
    column += crossing.in_y ? 0 : (target_column > column ? 1 : -1);
    between.push_back({column, row});
  }
  if (!between.empty()) {
    between.pop_back();
  }
  return between;
}

Cells& cells_drawn(const DrawnMap& map, double cell_m) {
  static Cells cells;
  EXPECT_EQ(cells.build(map.view(), cell_m).code, RefusalCode::kNone);
  return cells;
}

DrawnMap random_map(std::mt19937_64& random, double cell_m, int occluders) {
  DrawnMap map(20 * cell_m, 15 * cell_m, cell_m);
  for (int i = 0; i < occluders; ++i) {
    const double x = cell_m * static_cast<double>(random() % 20);
    const double y = cell_m * static_cast<double>(random() % 15);
    map.put(i % 3 == 0 ? kWater : kTree, x, y, x + cell_m, y + cell_m);  // water hides nothing
  }
  return map;
}

TEST(LineOfSight, AgreesWithASlowWalkInWholeNumbers) {
  std::mt19937_64 random(41);
  int seen = 0;
  int looks = 0;
  for (const double cell_m : {1.0, 0.25}) {
    for (int i = 0; i < 40; ++i) {
      const DrawnMap map = random_map(random, cell_m, 10 + i);
      const Cells& cells = cells_drawn(map, cell_m);
      for (int k = 0; k < 1000; ++k) {
        const int coarse =
            k % 2 == 0 ? 1 : kParts / 2;  // every other position at a corner, a side's middle or a centre
        const int x = static_cast<int>(random() % (20 * kParts)) / coarse * coarse;
        const int y = static_cast<int>(random() % (15 * kParts)) / coarse * coarse;
        const Cell target = static_cast<Cell>(random() % 300);
        bool expected = true;
        for (const Step s : slow_walk(x, y, cells.column(target), cells.row(target))) {
          expected = expected && !cells.occluder(cells.at(s.column, s.row));
        }
        const Point from{x * cell_m / kParts, y * cell_m / kParts};
        ASSERT_EQ(line_of_sight(cells, from, target), expected)
            << "from " << x << "/16, " << y << "/16 to cell " << cells.column(target) << ", " << cells.row(target);
        seen += expected ? 1 : 0;
        ++looks;
      }
    }
  }
  EXPECT_GT(seen, looks / 10);
  EXPECT_LT(seen, looks - looks / 10);
}

// Away from corners: hidden exactly when the straight line passes through the inside of an occluding cell between.
TEST(LineOfSight, IsLostExactlyWhenTheLinePassesThroughAnOccluder) {
  std::mt19937_64 random(43);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    const Cells& cells = cells_drawn(random_map(random, 0.5, 30), 0.5);
    for (int k = 0; k < 300; ++k) {
      const Point from{10.0 * unit(random), 7.5 * unit(random)};
      const Cell target = static_cast<Cell>(random() % 300);
      const Point to = cells.centre(target);
      bool hidden = false;
      bool grazes = false;
      for (Cell c = 0; c < cells.count(); ++c) {
        const bool own =
            c == target || c == cells.at(static_cast<int>(from.x_m / 0.5), static_cast<int>(from.y_m / 0.5));
        if (own || !cells.occluder(c)) {
          continue;
        }
        double enter = 0.0;
        double leave = 1.0;
        const auto clip = [&](double at, double along, double low) {
          const double t1 = (low - at) / along;
          const double t2 = (low + 0.5 - at) / along;
          enter = std::max(enter, std::min(t1, t2));
          leave = std::min(leave, std::max(t1, t2));
        };
        clip(from.x_m, to.x_m - from.x_m, 0.5 * cells.column(c));
        clip(from.y_m, to.y_m - from.y_m, 0.5 * cells.row(c));
        grazes = grazes || std::abs(leave - enter) < 1e-9;
        hidden = hidden || leave > enter;
      }
      if (!grazes) {
        ASSERT_EQ(line_of_sight(cells, from, target), !hidden);
      }
    }
  }
}

TEST(LineOfSight, StepsInYFirstAtAnExactCorner) {
  const Point low{0.5, 0.5};
  const Point high{1.5, 1.5};
  DrawnMap upper_left(2.0, 2.0, 1.0);
  upper_left.put(kWall, 0.0, 1.0, 1.0, 2.0);
  EXPECT_FALSE(line_of_sight(cells_drawn(upper_left, 1.0), low, 3));
  EXPECT_TRUE(line_of_sight(cells_drawn(upper_left, 1.0), high, 0));
  DrawnMap lower_right(2.0, 2.0, 1.0);
  lower_right.put(kWall, 1.0, 0.0, 2.0, 1.0);
  EXPECT_TRUE(line_of_sight(cells_drawn(lower_right, 1.0), low, 3));
  EXPECT_FALSE(line_of_sight(cells_drawn(lower_right, 1.0), high, 0));
}

TEST(LineOfSight, DoesNotMindTheCellsAtItsEnds) {
  DrawnMap map(5.0, 1.0, 1.0);
  map.put(kWall, 0.0, 0.0, 1.0, 1.0).put(kWall, 4.0, 0.0, 5.0, 1.0);
  EXPECT_TRUE(line_of_sight(cells_drawn(map, 1.0), {0.5, 0.5}, 4));
  EXPECT_TRUE(line_of_sight(cells_drawn(map, 1.0), {0.5, 0.5}, 0));
  map.put(kWall, 2.0, 0.0, 3.0, 1.0);
  EXPECT_FALSE(line_of_sight(cells_drawn(map, 1.0), {0.5, 0.5}, 4));
}

TEST(LineOfSight, StartsFromTheMapsFarBorderToo) {
  const Cells& cells = cells_drawn(DrawnMap(4.0, 3.0, 1.0), 1.0);
  EXPECT_TRUE(line_of_sight(cells, {4.0, 3.0}, 0));
  EXPECT_TRUE(line_of_sight(cells, {4.0, 0.0}, cells.at(0, 2)));
}

TEST(WithinRadius, KeepsCellsOnTheCircleWhateverTheRounding) {
  const Cells& cells = cells_drawn(DrawnMap(10.0, 10.0, 0.25), 0.25);
  EXPECT_TRUE(within_radius(cells, {0.125, 0.125}, cells.at(10, 0), 2.5));
  EXPECT_TRUE(within_radius(cells, {0.125, 0.125}, cells.at(6, 8), 2.5));  // 1.5 by 2
  EXPECT_FALSE(within_radius(cells, {0.125, 0.125}, cells.at(10, 0), 2.4999));
  EXPECT_TRUE(within_radius(cells, {0.125 - 1e-10, 0.125}, cells.at(10, 0), 2.5));
}

TEST(ForEachSeen, FindsWhatALookAtEveryCellFindsRowByRow) {
  std::mt19937_64 random(47);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const Cells& cells = cells_drawn(random_map(random, 0.5, i % 2 == 0 ? 0 : 25), 0.5);
    for (int k = 0; k < 20; ++k) {
      const Point from{10.0 * unit(random), 7.5 * unit(random)};
      const double radius_m = 0.1 + 6.0 * unit(random);
      std::vector<Cell> expected;
      for (Cell c = 0; c < cells.count(); ++c) {
        if (within_radius(cells, from, c, radius_m) && line_of_sight(cells, from, c)) {
          expected.push_back(c);
        }
      }
      std::vector<Cell> seen;
      for_each_seen(cells, from, radius_m, [&](Cell c) { seen.push_back(c); });
      ASSERT_EQ(seen, expected);
    }
  }
}

TEST(SightPoints, AreAtMostHalfACellApartAndIncludeBothEnds) {
  EXPECT_EQ(sight_points(3.5, 0.25), 28);
  EXPECT_EQ(sight_points(3.51, 0.25), 29);
  EXPECT_EQ(sight_points(0.01, 0.25), 1);
  EXPECT_EQ(sight_points(0.0, 0.25), 1);
  const Point a{1.0, 2.0};
  const Point b{4.0, 6.0};
  EXPECT_EQ(sight_point(a, b, 0, 40), a);
  EXPECT_EQ(sight_point(a, b, 40, 40), b);
  EXPECT_DOUBLE_EQ(sight_point(a, b, 10, 40).x_m, 1.75);
  EXPECT_DOUBLE_EQ(sight_point(a, b, 10, 40).y_m, 3.0);
}

TEST(SightPoints, HaveTheSameBitsInBothDirections) {
  std::mt19937_64 random(53);
  std::uniform_real_distribution<double> where(0.0, 40.0);
  for (int i = 0; i < 500; ++i) {
    const Point a{where(random), where(random)};
    const Point b = i % 5 == 0 ? Point{a.x_m, where(random)} : Point{where(random), where(random)};
    const int n = 1 + static_cast<int>(random() % 90);
    for (int k = 0; k <= n; ++k) {
      ASSERT_EQ(sight_point(a, b, k, n), sight_point(b, a, n - k, n));
    }
  }
}

// A path that ends on a sight point has the points of the whole edge up to there.
TEST(SightPoints, StayTheSameInNumberWhenAMoveIsCutAtOneOfThem) {
  std::mt19937_64 random(59);
  std::uniform_real_distribution<double> where(0.0, 12.0);
  for (int i = 0; i < 2000; ++i) {
    const Point a{where(random), where(random)};
    const Point b{where(random), where(random)};
    const int n = sight_points(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m), 0.25);
    for (int k = 1; k <= n; ++k) {
      const Point end = sight_point(a, b, k, n);
      ASSERT_EQ(sight_points(std::hypot(end.x_m - a.x_m, end.y_m - a.y_m), 0.25), k);
    }
  }
}

}  // namespace
}  // namespace ivo::planner
