#include "planner/numeric/roulette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ivo::planner {
namespace {

// A trail of the build's kind; at most 1.
Trail trail(double value) {
#if IVO_PLANNER_FIXED
  return static_cast<Trail>(value * (1 << kTrailBits) + 0.5);
#else
  return value;
#endif
}

double as_double(Weight weight) { return static_cast<double>(weight) * (kFixedPoint ? 0x1p-38 : 1.0); }

TEST(Roulette, DrawsByTheWeights) {
  constexpr std::array<double, 5> kTrails = {0.01, 0.002, 0.01, 0.0005, 0.01};
  constexpr std::array<double, 5> kEtas = {1.0, 4.0, 0.25, 8.0, 0.0625};
  std::array<Weight, 5> sums{};
  Weight sum{};
  double whole = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    sum += weight_of(trail(kTrails[i]), visibility_from(kEtas[i]));
    sums[i] = sum;
    whole += kTrails[i] * kEtas[i];
  }
  Rng rng(81);
  constexpr int kDraws = 200'000;
  std::array<int, 5> drawn{};
  for (int i = 0; i < kDraws; ++i) {
    const auto found = std::upper_bound(sums.begin(), sums.end(), draw_below(sum, rng));
    ASSERT_NE(found, sums.end());
    ++drawn[static_cast<std::size_t>(found - sums.begin())];
  }
  double chi2 = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const double expected = kDraws * kTrails[i] * kEtas[i] / whole;
    chi2 += (drawn[i] - expected) * (drawn[i] - expected) / expected;
  }
  EXPECT_LT(chi2, 18.5);  // 4 degrees of freedom, 0.1 %
}

TEST(Roulette, DrawsEvenlyBelowAnySum) {
  Rng rng(82);
  for (const double whole : {1e-9, 1e-3, 1.0, 1000.0, 4e6}) {
#if IVO_PLANNER_FIXED
    const auto sum = static_cast<Weight>(whole * 0x1p38);
#else
    const Weight sum = whole;
#endif
    double total = 0.0;
    double least = 2.0;
    double most = 0.0;
    constexpr int kDraws = 20'000;
    for (int i = 0; i < kDraws; ++i) {
      const Weight draw = draw_below(sum, rng);
      ASSERT_LT(draw, sum);
      ASSERT_GE(draw, Weight{});
      const double share = as_double(draw) / as_double(sum);
      total += share;
      least = std::min(least, share);
      most = std::max(most, share);
    }
    EXPECT_NEAR(total / kDraws, 0.5, 0.01) << whole;
    EXPECT_LT(least, 0.01) << whole;
    EXPECT_GT(most, 0.99) << whole;
  }
}

TEST(Roulette, WeighsAsTheProductDoes) {
  Rng rng(83);
  for (int i = 0; i < 10'000; ++i) {
    const double tau = rng.unit();
    const double eta = std::pow(2.0, 26.0 * rng.unit() - 12.0);
    const Weight weight = weight_of(trail(tau), visibility_from(eta));
    // Half a unit of each factor, and what the product drops.
    const double error = kFixedPoint ? 0x1p-31 * eta + 0x1p-19 * tau + 0x1p-38 + 0x1p-49 : 1e-12 * tau * eta;
    ASSERT_NEAR(as_double(weight), tau * eta, error);
  }
}

TEST(Roulette, NeverClosesAnEdgeForItsLength) {
  EXPECT_GT(visibility_from(std::pow(1.0 / 4.25, 12.0)), Visibility{});  // the longest edge, the largest beta
  EXPECT_GT(weight_of(trail(0.001), visibility_from(std::pow(1.0 / 4.25, 12.0))), Weight{});
}

#if IVO_PLANNER_FIXED

TEST(Roulette, KeepsAVisibilityBetweenOneUnitAndItsLargest) {
  EXPECT_EQ(visibility_from(0.0), 1U);
  EXPECT_EQ(visibility_from(1e-12), 1U);
  EXPECT_EQ(visibility_from(1.0), 1U << kVisibilityBits);
  EXPECT_EQ(visibility_from(16'383.0), 16'383U << kVisibilityBits);
  EXPECT_EQ(visibility_from(1e36), 0xFFFFFFFFU);  // starts on one place: (1000)^12
}

TEST(Roulette, HoldsTheLargestWeightsOfANode) {
  // Trail 1 at the largest visibility is 2^52; as many neighbours as a node can have stay below 2^64.
  const Weight largest = weight_of(1U << kTrailBits, 0xFFFFFFFFU);
  EXPECT_LT(largest, Weight{1} << 52U);
  EXPECT_GT(largest, (Weight{1} << 52U) - (Weight{1} << 21U));
  Weight sum = 0;
  for (int i = 0; i < 4000; ++i) {
    ASSERT_GT(sum + largest, sum);
    sum += largest;
  }
  EXPECT_EQ(weight_of(0xFFFFFFFFU, 0xFFFFFFFFU), 0xFFFFFFFE00000001U >> 10U);
}

TEST(Roulette, DrawsTheLastUnitBelowASumOfAllBits) {
  Rng rng(84);
  for (const Weight sum : {Weight{1}, Weight{2}, ~Weight{0}, Weight{1} << 63U, (Weight{1} << 32U) - 1}) {
    for (int i = 0; i < 1000; ++i) {
      ASSERT_LT(draw_below(sum, rng), sum);
    }
  }
}

#endif

}  // namespace
}  // namespace ivo::planner
