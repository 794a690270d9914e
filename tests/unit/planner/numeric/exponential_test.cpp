#include "planner/numeric/exponential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ivo::planner {
namespace {

TEST(ExpNegative, IsOneAtZero) { EXPECT_EQ(exp_negative(0.0), 1.0); }

TEST(ExpNegative, AgreesWithTheLibraryWithinItsStatedError) {
  std::mt19937_64 random(1);
  for (const double range : {1e-12, 1e-3, 1.0, 20.0, 700.0}) {
    std::uniform_real_distribution<double> below_zero(-range, 0.0);
    for (int i = 0; i < 20'000; ++i) {
      const double x = below_zero(random);
      const double expected = std::exp(x);
      ASSERT_NEAR(exp_negative(x) / expected, 1.0, 4e-16 * (1.0 + std::abs(x))) << "x = " << x;
    }
  }
}

TEST(ExpNegative, AgreesWhereTheArgumentIsHalfwayBetweenTwoPowersOfTwo) {
  const double ln2 = std::log(2.0);
  for (int n = 0; n < 1000; ++n) {
    for (const double nudge : {-1e-15, 0.0, 1e-15}) {
      const double x = -(n + 0.5) * ln2 * (1.0 + nudge);
      ASSERT_NEAR(exp_negative(x) / std::exp(x), 1.0, 4e-16 * (1.0 + std::abs(x))) << "x = " << x;
    }
  }
}

TEST(ExpNegative, FallsToZeroBelowMinusSevenHundred) {
  EXPECT_GT(exp_negative(-700.0), 0.0);
  EXPECT_EQ(exp_negative(-700.001), 0.0);
  EXPECT_EQ(exp_negative(-1e300), 0.0);
}

TEST(ExpNegativeDeathTest, RefusesAPositiveArgument) { EXPECT_DEATH((void)exp_negative(1e-9), ""); }

}  // namespace
}  // namespace ivo::planner
