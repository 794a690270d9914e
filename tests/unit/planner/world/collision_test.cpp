#include "planner/world/collision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using test::DrawnMap;
using enum SemanticClass;

double point_to_segment_m(Point p, Point a, Point b) {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((p.x_m - a.x_m) * dx + (p.y_m - a.y_m) * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(a.x_m + t * dx - p.x_m, a.y_m + t * dy - p.y_m);
}

struct Rectangle {
  double x0, y0, x1, y1;
};

double point_to_rectangle_m(Point p, const Rectangle& r) {
  return std::hypot(std::max({r.x0 - p.x_m, p.x_m - r.x1, 0.0}), std::max({r.y0 - p.y_m, p.y_m - r.y1, 0.0}));
}

// Clips the segment by each side in turn.
bool meets(Point a, Point b, const Rectangle& r) {
  double enter = 0.0;
  double leave = 1.0;
  const auto clip = [&](double from, double along, double low, double high) {
    if (along == 0.0) {
      return from >= low && from <= high;
    }
    const double t1 = (low - from) / along;
    const double t2 = (high - from) / along;
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
    return true;
  };
  return clip(a.x_m, b.x_m - a.x_m, r.x0, r.x1) && clip(a.y_m, b.y_m - a.y_m, r.y0, r.y1) && enter <= leave;
}

double segment_to_rectangle_m(Point a, Point b, const Rectangle& r) {
  if (meets(a, b, r)) {
    return 0.0;
  }
  double nearest = std::min(point_to_rectangle_m(a, r), point_to_rectangle_m(b, r));
  for (const Point corner : {Point{r.x0, r.y0}, Point{r.x1, r.y0}, Point{r.x0, r.y1}, Point{r.x1, r.y1}}) {
    nearest = std::min(nearest, point_to_segment_m(corner, a, b));
  }
  return nearest;
}

// From the segment to the nearest pixel of the set or to the border, over every pixel of the map.
double slow_clearance_m(const SegmentedMap& map, ClassSet blocked, Point a, Point b) {
  double nearest = 1e9;
  for (const Point p : {a, b}) {
    nearest = std::min({nearest, p.x_m, p.y_m, map.width_m() - p.x_m, map.height_m() - p.y_m});
  }
  for (int row = 0; row < map.height_px; ++row) {
    for (int column = 0; column < map.width_px; ++column) {
      if (((blocked >> static_cast<unsigned>(map.at(column, row))) & 1U) != 0) {
        const double size = map.resolution_m;
        nearest = std::min(
            nearest, segment_to_rectangle_m(a, b, {column * size, row * size, (column + 1) * size, (row + 1) * size}));
      }
    }
  }
  return std::max(0.0, nearest);
}

DrawnMap random_map(std::mt19937_64& random) {
  constexpr std::array<SemanticClass, 5> kDrawn = {kBuilding, kWater, kStreetFurniture, kStairs, kGrass};
  DrawnMap map(8.0, 6.0, 0.25);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 9; ++i) {
    const double x = 8.0 * unit(random);
    const double y = 6.0 * unit(random);
    map.put(kDrawn[random() % kDrawn.size()], x, y, x + 0.2 + unit(random), y + 0.2 + unit(random));
  }
  return map;
}

TEST(ClassSets, AreTheObstaclesAndWhatAnAgentMayNotEnter) {
  const ClassTable classes = default_class_table();
  EXPECT_EQ(obstacle_classes(classes), 0b01'1111'1000'0000);
  EXPECT_EQ(restricted_classes(classes, AgentKind::kRobot), 0b10'0000'0000'0000);
  EXPECT_EQ(restricted_classes(classes, AgentKind::kPerson), 0);
}

TEST(Clearance, IsTheDistanceToTheNearestPixelOrTheBorder) {
  DrawnMap map(10.0, 10.0, 0.5);
  map.put(kWall, 5.0, 5.0, 6.0, 6.0);
  const ClassSet obstacles = obstacle_classes(default_class_table());
  EXPECT_DOUBLE_EQ(clearance(map.view(), obstacles, {4.0, 5.5}, 3.0), 1.0);
  EXPECT_DOUBLE_EQ(clearance(map.view(), obstacles, {4.7, 4.6}, 3.0), 0.5);
  EXPECT_DOUBLE_EQ(clearance(map.view(), obstacles, {0.25, 5.0}, 3.0), 0.25);
  EXPECT_DOUBLE_EQ(clearance(map.view(), obstacles, {2.5, 2.5}, 1.0), 1.0);
  EXPECT_EQ(clearance(map.view(), obstacles, {5.5, 5.5}, 3.0), 0.0);
  EXPECT_EQ(clearance(map.view(), obstacles, {-1.0, 5.0}, 3.0), 0.0);
  EXPECT_EQ(clearance(map.view(), obstacles, {10.0, 5.0}, 3.0), 0.0);
}

TEST(Clearance, AgreesWithASearchOfTheWholeMap) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const ClassSet obstacles = obstacle_classes(default_class_table());
  for (int i = 0; i < 40; ++i) {
    const DrawnMap map = random_map(random);
    for (int k = 0; k < 25; ++k) {
      const Point p{8.0 * unit(random), 6.0 * unit(random)};
      const double limit_m = 2.0 * unit(random);
      ASSERT_NEAR(clearance(map.view(), obstacles, p, limit_m),
                  std::min(limit_m, slow_clearance_m(map.view(), obstacles, p, p)), 1e-12);
    }
  }
}

TEST(SweptDisc, AgreesWithDistancesToEveryPixel) {
  std::mt19937_64 random(77);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const ClassTable classes = default_class_table();
  const std::array<ClassSet, 2> sets = {
      obstacle_classes(classes),
      static_cast<ClassSet>(obstacle_classes(classes) | restricted_classes(classes, AgentKind::kRobot))};
  constexpr double kTouching = 1e-4;  // what the header promises
  int free = 0;
  int judged = 0;
  for (int i = 0; i < 60; ++i) {
    const DrawnMap map = random_map(random);
    for (int k = 0; k < 60; ++k) {
      const Point a{8.0 * unit(random), 6.0 * unit(random)};
      const double reach = 0.3 + 3.0 * unit(random);
      const double angle = 6.283185307179586 * unit(random);
      const Point b =
          k % 10 == 0 ? a
                      : Point{a.x_m + reach * std::cos(angle), a.y_m + (k % 10 == 1 ? 0.0 : reach * std::sin(angle))};
      const double radius_m = 0.05 + 0.6 * unit(random);
      const ClassSet blocked = sets[random() % 2];
      const double distance_m = slow_clearance_m(map.view(), blocked, a, b);
      if (std::abs(distance_m - radius_m) < kTouching) {
        continue;
      }
      ++judged;
      free += distance_m > radius_m ? 1 : 0;
      ASSERT_EQ(swept_disc_is_free(map.view(), blocked, a, b, radius_m), distance_m > radius_m)
          << "from " << a.x_m << ", " << a.y_m << " to " << b.x_m << ", " << b.y_m << ", radius " << radius_m
          << ", distance " << distance_m;
    }
  }
  EXPECT_GT(judged, 3000);
  EXPECT_GT(free, 500);
  EXPECT_LT(free, judged - 500);
}

TEST(SweptDisc, MayTouchTheBorderButNotLeave) {
  const DrawnMap map(10.0, 10.0, 0.5);
  EXPECT_TRUE(swept_disc_is_free(map.view(), 0, {0.3, 0.3}, {9.7, 9.7}, 0.3));
  EXPECT_FALSE(swept_disc_is_free(map.view(), 0, {0.29, 5.0}, {5.0, 5.0}, 0.3));
  EXPECT_FALSE(swept_disc_is_free(map.view(), 0, {5.0, 5.0}, {5.0, 9.71}, 0.3));
}

TEST(SweptDisc, SlipsThroughAGapOfItsWidthAndNoNarrower) {
  DrawnMap map(10.0, 10.0, 0.1);
  map.put(kWall, 4.0, 0.0, 6.0, 4.6).put(kWall, 4.0, 5.4, 6.0, 10.0);
  const ClassSet obstacles = obstacle_classes(default_class_table());
  EXPECT_TRUE(swept_disc_is_free(map.view(), obstacles, {2.0, 5.0}, {8.0, 5.0}, 0.39));
  EXPECT_FALSE(swept_disc_is_free(map.view(), obstacles, {2.0, 5.0}, {8.0, 5.0}, 0.41));
}

}  // namespace
}  // namespace ivo::planner
