#include "planner/world/polygon.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <random>

namespace ivo::planner {
namespace {

Area area_of(std::initializer_list<Point> corners) {
  Area area;
  for (const Point corner : corners) {
    EXPECT_TRUE(area.push_back(corner));
  }
  return area;
}

// An L: the square of side 4 without its upper right quarter.
Area ell() { return area_of({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}); }

TEST(Area, HoldsWhatIsInsideThoughItIsNotConvex) {
  EXPECT_TRUE(contains(ell(), {1, 1}));
  EXPECT_TRUE(contains(ell(), {3, 1}));
  EXPECT_TRUE(contains(ell(), {1, 3}));
  EXPECT_FALSE(contains(ell(), {3, 3}));
  EXPECT_FALSE(contains(ell(), {-1, 1}));
  EXPECT_FALSE(contains(ell(), {5, 1}));
}

TEST(Area, SharesABorderSoThatEachPointLiesInOne) {
  const Area left = area_of({{0, 0}, {1, 0}, {1, 2}, {0, 2}});
  const Area right = area_of({{1, 0}, {2, 0}, {2, 2}, {1, 2}});
  for (int i = 1; i < 20; ++i) {
    const Point p{1.0, 0.1 * i};
    EXPECT_NE(contains(left, p), contains(right, p)) << p.y_m;
  }
}

TEST(Area, OfNoVertexHoldsNothing) {
  EXPECT_FALSE(contains(Area{}, {0, 0}));
  EXPECT_FALSE(contains(Areas{}, {0, 0}));
  EXPECT_FALSE(touches(Areas{}, {0, 0}, {1, 1}));
}

TEST(Area, IsTouchedByAPathThatCrossesItWithBothEndsOutside) {
  EXPECT_TRUE(touches(ell(), {-1, 1}, {5, 1}));
  EXPECT_TRUE(touches(ell(), {3, -1}, {3, 5}));
  EXPECT_FALSE(touches(ell(), {3, 3}, {5, 5}));
  EXPECT_FALSE(touches(ell(), {2.5, 4}, {4, 2.5}));
  EXPECT_FALSE(touches(ell(), {-1, -1}, {5, -1}));
}

TEST(Area, IsTouchedByAPathInsideOrThroughAVertexOrAlongASide) {
  EXPECT_TRUE(touches(ell(), {0.5, 0.5}, {1.5, 0.5}));
  EXPECT_TRUE(touches(ell(), {1, 3}, {3, 1}));
  EXPECT_FALSE(touches(ell(), {3, 5}, {5, 3}));
  EXPECT_TRUE(touches(ell(), {-1, 5}, {1, 3}));
  EXPECT_TRUE(touches(ell(), {5, 0}, {-1, 0}));
  EXPECT_TRUE(touches(ell(), {4, 2}, {6, 4}));
}

TEST(Area, IsTouchedExactlyWhenSomePointOfThePathIsInside) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> where(-2.0, 6.0);
  constexpr double g = 0.01;  // wider than half the step between samples
  const Area grown = area_of({{-g, -g}, {4 + g, -g}, {4 + g, 2 + g}, {2 + g, 2 + g}, {2 + g, 4 + g}, {-g, 4 + g}});
  for (int i = 0; i < 2000; ++i) {
    const Point a{where(random), where(random)};
    const Point b{where(random), where(random)};
    bool inside = false;
    bool near = false;
    for (int k = 0; k <= 1000; ++k) {
      const Point p{a.x_m + (b.x_m - a.x_m) * k / 1000, a.y_m + (b.y_m - a.y_m) * k / 1000};
      inside = inside || contains(ell(), p);
      near = near || contains(grown, p);
    }
    ASSERT_TRUE(touches(ell(), a, b) || !inside);
    ASSERT_TRUE(near || !touches(ell(), a, b));
  }
}

}  // namespace
}  // namespace ivo::planner
