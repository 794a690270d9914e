#include "config/base/time_histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ivo {
namespace {

TEST(TimeHistogram, EveryTimeIsToldWithinOnePartInSixteen) {
  for (double ns = 1.0; ns < 4.2e9; ns *= 1.013) {
    TimeHistogram histogram;
    const Duration time(static_cast<Duration::rep>(ns));
    histogram.add(time);
    histogram.add(Duration(5'000'000'000));  // so that worst() cuts nothing
    const Duration told = histogram.quantile(0.5);
    ASSERT_GE(told, time);
    ASSERT_LE(static_cast<double>(told.count()), std::ceil(static_cast<double>(time.count()) * (1.0 + 1.0 / 16.0)));
  }
}

TEST(TimeHistogram, QuantilesCountFromTheLeastAndTheWorstIsExact) {
  TimeHistogram histogram;
  for (int i = 1; i <= 1000; ++i) {
    histogram.add(Duration(i * 1000));
  }
  EXPECT_EQ(histogram.count(), 1000U);
  EXPECT_EQ(histogram.total(), Duration(500'500'000));
  EXPECT_NEAR(static_cast<double>(histogram.quantile(0.5).count()), 500e3, 500e3 / 16);
  EXPECT_NEAR(static_cast<double>(histogram.quantile(0.99).count()), 990e3, 990e3 / 16);
  EXPECT_EQ(histogram.worst(), Duration(1'000'000));
  EXPECT_EQ(histogram.quantile(1.0), Duration(1'000'000));
  EXPECT_EQ(histogram.quantile(0.0), Duration(1023)) << "the end of the first bucket that holds one";
}

TEST(TimeHistogram, WithoutAValueEverythingIsZero) {
  const TimeHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), Duration(0));
  EXPECT_EQ(histogram.worst(), Duration(0));
}

TEST(TimeHistogram, TimesBelowZeroAndBeyondTheLastBucketAreKept) {
  TimeHistogram histogram;
  histogram.add(Duration(-5));
  histogram.add(Duration(60'000'000'000));
  EXPECT_EQ(histogram.quantile(0.5), Duration(0));
  EXPECT_EQ(histogram.worst(), Duration(60'000'000'000));
  EXPECT_EQ(histogram.between(Duration(0), Duration(1)), 1U);
  EXPECT_EQ(histogram.between(Duration(1'000'000'000), Duration(5'000'000'000)), 1U);
}

}  // namespace
}  // namespace ivo
