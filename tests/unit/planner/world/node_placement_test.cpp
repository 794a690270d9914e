#include "planner/world/node_placement.hpp"

#include <gtest/gtest.h>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

constexpr Square kSquare{4.0, 4.0, 8.0, 8.0};  // of side 4 in a map of 12 x 12
constexpr double kClearance = 0.40;

DrawnMap open_map() { return DrawnMap(12.0, 12.0, 0.1); }

void expect_node(const DrawnMap& map, Point expected, const Square& square = kSquare) {
  const std::optional<Point> node = place_node(map.view(), square, kClearance);
  ASSERT_TRUE(node.has_value());
  EXPECT_NEAR(node->x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(node->y_m, expected.y_m, 1e-9);
}

TEST(NodePlacement, TakesTheCentreOfAFreeSquare) { expect_node(open_map(), {6.0, 6.0}); }

TEST(NodePlacement, TakesTheCentreThoughSomethingStandsInTheSquareFarEnough) {
  expect_node(open_map().put(kWall, 6.4, 4.0, 8.0, 8.0), {6.0, 6.0});
}

TEST(NodePlacement, TakesTheCentroidOfTheFreeAreaWhenTheCentreIsTooNear) {
  expect_node(open_map().put(kWall, 6.3, 4.0, 8.0, 8.0), {5.15, 6.0});
}

TEST(NodePlacement, CountsPixelsThatTheSquareCutsByThePartInside) {
  DrawnMap map(12.0, 12.0, 0.5);
  map.put(kWall, 6.0, 0.0, 12.0, 12.0);
  // Free from 4.2 to 6.0, from 4.2 to 7.9.
  expect_node(map, {5.1, 6.05}, {4.2, 4.2, 7.9, 7.9});
}

TEST(NodePlacement, IgnoresWhatDoesNotBlockMotion) {
  expect_node(open_map().put(kStairs, 4.0, 4.0, 8.0, 8.0), {6.0, 6.0});
}

TEST(NodePlacement, TakesTheCornerNearestToTheCentroidWhenThatIsBlockedToo) {
  expect_node(open_map().put(kWall, 5.2, 5.2, 7.0, 7.0), {4.0, 4.0});
  expect_node(open_map().put(kWall, 4.8, 5.2, 6.5, 7.0), {8.0, 4.0});
  expect_node(open_map().put(kWall, 5.2, 4.8, 7.0, 6.5), {4.0, 8.0});
  expect_node(open_map().put(kWall, 4.8, 4.8, 6.5, 6.5), {8.0, 8.0});
}

TEST(NodePlacement, TakesTheLowerThenTheLeftCornerOnATie) {
  // A block in the very middle: the centroid is the centre, and all corners are equally far.
  for (const double half : {0.5, 1.0, 1.5}) {
    expect_node(open_map().put(kBuilding, 6 - half, 6 - half, 6 + half, 6 + half), {4.0, 4.0});
  }
  // Left corners blocked: the lower right one before the upper right one.
  expect_node(open_map().put(kBuilding, 5.0, 5.0, 7.0, 7.0).put(kWall, 3.4, 3.4, 3.9, 8.6), {8.0, 4.0});
  // Lower corners blocked: the upper left one before the upper right one.
  expect_node(open_map().put(kBuilding, 5.0, 5.0, 7.0, 7.0).put(kWall, 3.4, 3.4, 8.6, 3.9), {4.0, 8.0});
}

TEST(NodePlacement, KeepsToTieRulesWhateverTheRoundingOfTheSquare) {
  DrawnMap map(21.0, 21.0, 0.1);
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < 6; ++k) {
      map.put(kWall, i * 3.5 + 1.2, k * 3.5 + 1.2, i * 3.5 + 2.3, k * 3.5 + 2.3);
    }
  }
  for (int row = 1; row < 5; ++row) {
    for (int column = 1; column < 5; ++column) {
      const Square square{column * 3.5, row * 3.5, (column + 1) * 3.5, (row + 1) * 3.5};
      expect_node(map, {column * 3.5, row * 3.5}, square);
    }
  }
}

TEST(NodePlacement, TakesNoCornerOnTheBorder) {
  const Square lower_left{0.0, 0.0, 4.0, 4.0};
  expect_node(open_map().put(kBuilding, 1.0, 1.0, 3.0, 3.0), {4.0, 4.0}, lower_left);
}

TEST(NodePlacement, LeavesASquareEmptyThatHasNoClearPlace) {
  DrawnMap full = open_map();
  EXPECT_FALSE(place_node(full.put(kWater, 4.0, 4.0, 8.0, 8.0).view(), kSquare, kClearance).has_value());
  DrawnMap narrow = open_map();
  narrow.put(kWall, 3.0, 3.0, 9.0, 5.7).put(kWall, 3.0, 6.3, 9.0, 9.0);
  EXPECT_FALSE(place_node(narrow.view(), kSquare, kClearance).has_value());
}

TEST(NodePlacement, MindsTheBorderOfTheMap) {
  const DrawnMap map = open_map();
  EXPECT_FALSE(place_node(map.view(), {11.7, 4.0, 12.0, 8.0}, kClearance).has_value());
  expect_node(map, {11.6, 6.0}, {11.2, 4.0, 12.0, 8.0});
}

}  // namespace
}  // namespace ivo::planner
