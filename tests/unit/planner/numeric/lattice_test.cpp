#include "planner/numeric/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ivo::planner {
namespace {

TEST(Lattice, HasTheNearestSpotOfAPlace) {
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> metre(-50.0, 5000.0);
  for (int i = 0; i < 10'000; ++i) {
    const Point p{metre(random), metre(random)};
    const Point q = point_of(spot_at(p));
    ASSERT_LE(std::abs(q.x_m - p.x_m), 0.5 / kTicksAMetre);
    ASSERT_LE(std::abs(q.y_m - p.y_m), 0.5 / kTicksAMetre);
  }
  EXPECT_EQ(spot_at({-0.5 / 64, 0.0}), (Spot{0, 0}));
  EXPECT_EQ(spot_at({-0.51 / 64, 0.51 / 64}), (Spot{-1, 1}));
}

TEST(Lattice, GivesASpotBackToTheBit) {
  std::mt19937_64 random(72);
  for (int i = 0; i < 10'000; ++i) {
    const Spot s{static_cast<std::int32_t>(random() >> 40U) - (1 << 23),
                 static_cast<std::int32_t>(random() >> 40U) - (1 << 23)};
    ASSERT_EQ(spot_at(point_of(s)), s);
  }
}

// Less than `below_m` short, never long; in doubles to their rounding.
void expect_distance(Spot a, Spot b, double below_m) {
  const double dx = static_cast<double>(b.x) - a.x;
  const double dy = static_cast<double>(b.y) - a.y;
  const double exact_m = std::hypot(dx, dy) / kTicksAMetre;
  const double error_m = exact_m - to_double(distance(a, b));
  const double rounding_m = 1e-12 * (1.0 + exact_m);
  ASSERT_GE(error_m, -rounding_m) << dx << ", " << dy;
  ASSERT_LT(error_m, (kFixedPoint ? below_m : 0.0) + rounding_m) << dx << ", " << dy;
}

TEST(Lattice, MeasuresToAMillionthOfAMetreUpTo4Kilometres) {
  std::mt19937_64 random(73);
  for (int i = 0; i < 20'000; ++i) {
    const unsigned shift = 46U + static_cast<unsigned>(random() % 17U);
    const Spot a{static_cast<std::int32_t>(random() >> shift), static_cast<std::int32_t>(random() >> shift)};
    const Spot b{static_cast<std::int32_t>(random() >> shift), static_cast<std::int32_t>(random() >> shift)};
    const double apart_m = std::hypot(b.x - a.x, b.y - a.y) / kTicksAMetre;
    ASSERT_NO_FATAL_FAILURE(expect_distance(a, b, apart_m < 4096.0 ? 0x1p-20 : 1.0 / kTicksAMetre));
  }
  ASSERT_NO_FATAL_FAILURE(expect_distance({0, 0}, {4096 * kTicksAMetre - 1, 0}, 0x1p-20));
  EXPECT_EQ(to_double(distance({3, 4}, {3, 4})), 0.0);
  EXPECT_EQ(to_double(distance({0, 0}, {3 * 64, -4 * 64})), 5.0);
}

TEST(Lattice, MeasuresToATickAtTheEdgeOfItsRange) {
  constexpr std::int32_t kFar = (1 << 30) - 1;
  for (const Spot b : {Spot{kFar, kFar}, Spot{kFar, 0}, Spot{4096 * kTicksAMetre, 0}, Spot{4096 * kTicksAMetre, 7}}) {
    ASSERT_NO_FATAL_FAILURE(expect_distance({0, 0}, b, 1.0 / kTicksAMetre));
    ASSERT_NO_FATAL_FAILURE(expect_distance(b, {0, 0}, 1.0 / kTicksAMetre));
  }
  ASSERT_NO_FATAL_FAILURE(expect_distance({-kFar, 5}, {kFar, 5}, 1.0 / kTicksAMetre));
}

TEST(Lattice, IsTheSameDistanceBothWays) {
  std::mt19937_64 random(74);
  for (int i = 0; i < 10'000; ++i) {
    const Spot a{static_cast<std::int32_t>(random() >> 48U), static_cast<std::int32_t>(random() >> 48U)};
    const Spot b{static_cast<std::int32_t>(random() >> 48U), static_cast<std::int32_t>(random() >> 48U)};
    ASSERT_EQ(distance(a, b), distance(b, a));
  }
}

TEST(Lattice, CountsWholeTicksRoundedDown) {
  EXPECT_EQ(whole_ticks(Metres(1.0)), 64);
  EXPECT_EQ(whole_ticks(Metres(0.0)), 0);
  EXPECT_EQ(whole_ticks(Metres(1.0 - 0x1p-20)), 63);
  EXPECT_EQ(whole_ticks(distance({0, 0}, {5, 0})), 5);
  EXPECT_EQ(whole_ticks(distance({0, 0}, {5, 5})), 7);
}

TEST(Lattice, TakesALengthAtAPaceToTheBitOfSeconds) {
  std::mt19937_64 random(75);
  std::uniform_real_distribution<double> length_m(0.0, 4096.0);
  std::uniform_real_distribution<double> pace(0.5, 50.0);
  for (int i = 0; i < 10'000; ++i) {
    const Metres length(length_m(random));
    const SecondsAMetre slowness(pace(random));
    const double exact = to_double(length) * to_double(slowness);
    const double error = exact - to_double(duration(length, slowness));
    ASSERT_GE(error, -1e-9);
    ASSERT_LT(error, kFixedPoint ? 0x1p-16 + 1e-9 : 1e-9);
  }
}

}  // namespace
}  // namespace ivo::planner
