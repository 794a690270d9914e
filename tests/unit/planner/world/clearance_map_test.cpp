#include "planner/world/clearance_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

using enum SemanticClass;

class ClearanceMapTest : public testing::Test {
 protected:
  void build(const test::DrawnMap& map, double cell_m) {
    ASSERT_FALSE(cells_->build(map.view(), cell_m));
    blocked_ = obstacle_classes(map.view().classes);
    clearance_->build(map.view(), *cells_, blocked_);
  }

  std::unique_ptr<Cells> cells_ = std::make_unique<Cells>();
  std::unique_ptr<ClearanceMap> clearance_ = std::make_unique<ClearanceMap>();
  ClassSet blocked_ = 0;
};

test::DrawnMap drawn(std::mt19937_64& random, double pixel_m) {
  constexpr std::array<SemanticClass, 4> kThings = {kBuilding, kTree, kWater, kStreetFurniture};
  std::uniform_real_distribution<double> place(0.0, 14.0);
  std::uniform_real_distribution<double> size(0.05, 2.0);
  test::DrawnMap map(14.0, 12.0, pixel_m);
  for (int i = 0; i < 8; ++i) {
    const Point p{place(random), place(random)};
    map.put(kThings[random() % 4], p.x_m, p.y_m, p.x_m + size(random), p.y_m + size(random));
  }
  return map;
}

// Distance to the nearest obstacle pixel, the border left aside.
double distance_to_obstacle_m(const SegmentedMap& map, ClassSet blocked, Point p) {
  double least2 = 1e9;
  for (int y = 0; y < map.height_px; ++y) {
    for (int x = 0; x < map.width_px; ++x) {
      if (holds(blocked, map.at(x, y))) {
        const double size = map.resolution_m;
        const double dx = std::max({0.0, x * size - p.x_m, p.x_m - (x + 1) * size});
        const double dy = std::max({0.0, y * size - p.y_m, p.y_m - (y + 1) * size});
        least2 = std::min(least2, dx * dx + dy * dy);
      }
    }
  }
  return std::sqrt(least2);
}

TEST_F(ClearanceMapTest, NeverClaimsMoreThanTheDistanceToThePixels) {
  std::mt19937_64 random(21);
  std::uniform_int_distribution<std::int32_t> x(0, 14 * kTicksAMetre - 1);
  std::uniform_int_distribution<std::int32_t> y(0, 12 * kTicksAMetre - 1);
  double claimed = 0.0;
  double real = 0.0;
  for (int i = 0; i < 24; ++i) {
    const test::DrawnMap map = drawn(random, i % 2 == 0 ? 0.25 : 0.1);
    build(map, std::array{0.25, 0.5, 0.3}[random() % 3]);
    for (int k = 0; k < 100; ++k) {
      const Spot s{x(random), y(random)};
      const double real_m = distance_to_obstacle_m(map.view(), blocked_, point_of(s));
      const int ticks = clearance_->at_least(s);
      ASSERT_LE(ticks, real_m * kTicksAMetre);
      if (real_m < 2.0) {
        claimed += ticks;
        real += real_m * kTicksAMetre;
      }
    }
  }
  EXPECT_GT(claimed, 0.3 * real);  // nothing claimed would pass above
}

TEST_F(ClearanceMapTest, NeverCallsFreeWhatTheSweptDiscIsNot) {
  std::mt19937_64 random(22);
  std::uniform_int_distribution<std::int32_t> x(50, 14 * kTicksAMetre - 50);
  std::uniform_int_distribution<std::int32_t> y(50, 12 * kTicksAMetre - 50);
  std::uniform_int_distribution<std::int32_t> step(-100, 100);
  int free = 0;
  int surely = 0;
  int not_free = 0;
  for (int i = 0; i < 60; ++i) {
    const test::DrawnMap map = drawn(random, i % 2 == 0 ? 0.25 : 0.1);
    build(map, std::array{0.25, 0.5, 0.3}[random() % 3]);
    for (int k = 0; k < 300; ++k) {
      const Spot a{x(random), y(random)};
      const Spot near{std::clamp(a.x + step(random), 50, 14 * kTicksAMetre - 50),
                      std::clamp(a.y + step(random), 50, 12 * kTicksAMetre - 50)};
      const Spot b = k % 3 == 0 ? a : k % 3 == 1 ? near : Spot{x(random), y(random)};
      const int radius = static_cast<int>(random() % 45);
      const double radius_m = static_cast<double>(radius) / kTicksAMetre;
      const bool is_free = swept_disc_is_free(map.view(), blocked_, point_of(a), point_of(b), radius_m);
      const bool is_surely = clearance_->surely_free(a, b, radius);
      ASSERT_TRUE(!is_surely || is_free) << "map " << i << ", from " << a.x << ", " << a.y << " to " << b.x << ", "
                                         << b.y << ", radius " << radius;
      ASSERT_EQ(is_surely, clearance_->surely_free(a, b, radius));
      ++(is_free ? free : not_free);
      surely += is_surely ? 1 : 0;
    }
  }
  EXPECT_GT(surely, free / 3);
  EXPECT_GT(not_free, 3000);
}

TEST_F(ClearanceMapTest, LooksTenCellsFarOnAnOpenMap) {
  build(test::DrawnMap(20.0, 20.0, 0.25), 0.25);
  const int cells_ticks = kTicksAMetre / 4;
  EXPECT_GT(clearance_->at_least({640, 640}), 8 * cells_ticks);
  EXPECT_LE(clearance_->at_least({640, 640}), 10 * cells_ticks);
  EXPECT_TRUE(clearance_->surely_free({64, 64}, {1200, 700}, 19));
  EXPECT_EQ(clearance_->at_least({-100, 5000}), clearance_->at_least({0, 1279}));  // the map's nearest cell
}

TEST_F(ClearanceMapTest, SaysNothingInAnObstacle) {
  test::DrawnMap map(10.0, 10.0, 0.25);
  map.put(kBuilding, 4.0, 4.0, 6.0, 6.0);
  build(map, 0.25);
  EXPECT_EQ(clearance_->at_least(spot_at({5.0, 5.0})), 0);
  EXPECT_FALSE(clearance_->surely_free(spot_at({1.0, 5.0}), spot_at({9.0, 5.0}), 1));
  EXPECT_TRUE(clearance_->surely_free(spot_at({1.0, 1.0}), spot_at({9.0, 1.0}), 19));
}

}  // namespace
}  // namespace ivo::planner
