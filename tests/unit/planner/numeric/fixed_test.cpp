// Fixed point at the edges of its formats, and the formats that scalar.hpp names: whatever the build searches with.
#include "planner/numeric/fixed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "planner/numeric/scalar.hpp"
#include "planner/search/first_sightings.hpp"

namespace ivo::planner {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();

// The formats of scalar.hpp, by their bits behind the point.
template <class T>
class FixedFormat : public testing::Test {};
using Formats = testing::Types<Fixed<16>, Fixed<20>, Fixed<31>, Fixed<32>, Fixed<47>>;
TYPED_TEST_SUITE(FixedFormat, Formats);

TYPED_TEST(FixedFormat, ReachesFromMinusToPlusItsRange) {
  constexpr int kWholeBits = 63 - TypeParam::kFraction;
  const double range = std::ldexp(1.0, kWholeBits);
  EXPECT_EQ(static_cast<double>(TypeParam::from_raw(kLeast)), -range);
  EXPECT_LE(static_cast<double>(TypeParam::from_raw(kMost)), range);
  const double whole = range - 1.0;  // the largest whole number
  EXPECT_EQ(static_cast<double>(TypeParam(whole)), whole);
  EXPECT_EQ(static_cast<double>(TypeParam(-whole)), -whole);
  EXPECT_EQ((TypeParam(whole) + TypeParam::from_raw((std::int64_t{1} << TypeParam::kFraction) - 1)).raw(), kMost);
}

TYPED_TEST(FixedFormat, ResolvesItsLastBit) {
  const double bit = std::ldexp(1.0, -TypeParam::kFraction);
  EXPECT_EQ(TypeParam(bit).raw(), 1);
  EXPECT_EQ(TypeParam(-bit).raw(), -1);
  EXPECT_EQ(static_cast<double>(TypeParam::from_raw(1)), bit);
  EXPECT_LT(TypeParam{}, TypeParam::from_raw(1));
  EXPECT_LT(TypeParam::from_raw(-1), TypeParam{});
}

TYPED_TEST(FixedFormat, TakesANumberToTheNearestBit) {
  std::mt19937_64 random(61);
  const double bit = std::ldexp(1.0, -TypeParam::kFraction);
  std::uniform_real_distribution<double> value(-1000.0, 1000.0);
  for (int i = 0; i < 10'000; ++i) {
    const double x = value(random);
    ASSERT_LE(std::abs(static_cast<double>(TypeParam(x)) - x), 0.5 * bit);
  }
  EXPECT_EQ(TypeParam(0.49 * bit).raw(), 0);
  EXPECT_EQ(TypeParam(0.51 * bit).raw(), 1);
  EXPECT_EQ(TypeParam(-0.51 * bit).raw(), -1);
  EXPECT_EQ(TypeParam(7).raw(), TypeParam(7.0).raw());
}

TYPED_TEST(FixedFormat, AddsAndSubtractsWithoutLoss) {
  std::mt19937_64 random(62);
  for (int i = 0; i < 10'000; ++i) {
    const auto a = TypeParam::from_raw(static_cast<std::int64_t>(random()) / 2);
    const auto b = TypeParam::from_raw(static_cast<std::int64_t>(random()) / 2);
    ASSERT_EQ((a + b) - b, a);
    ASSERT_EQ((a + b).raw(), a.raw() + b.raw());
    ASSERT_EQ(-(-a), a);
    TypeParam c = a;
    c += b;
    c -= a;
    ASSERT_EQ(c, b);
  }
}

TYPED_TEST(FixedFormat, RoundsDownToFewerBits) {
  using Short = Fixed<8>;
  std::mt19937_64 random(63);
  for (int i = 0; i < 10'000; ++i) {
    const auto value = TypeParam::from_raw(static_cast<std::int64_t>(random()) >> 12);
    const auto rounded = round_to<Short>(value);
    const double error = static_cast<double>(value) - static_cast<double>(rounded);
    ASSERT_GE(error, 0.0);
    ASSERT_LT(error, 1.0 / 256);
  }
  EXPECT_EQ(round_to<Short>(TypeParam::from_raw(-1)).raw(), -1);
  EXPECT_EQ(round_to<TypeParam>(TypeParam::from_raw(-5)).raw(), -5);
}

TEST(Fixed, KeepsAllBitsOfAProduct) {
  std::mt19937_64 random(64);
  for (int i = 0; i < 10'000; ++i) {
    const auto mass = Fixed<31>::from_raw(static_cast<std::int64_t>(random() >> 33U));     // up to 1
    const auto seconds = Fixed<16>::from_raw(static_cast<std::int64_t>(random() >> 33U));  // up to 32,768 s
    const Fixed<47> product = mass * seconds;
    ASSERT_EQ(product.raw(), mass.raw() * seconds.raw());
  }
  // The whole mass at the last second that MassTime holds.
  EXPECT_EQ(static_cast<double>(Fixed<31>(1) * Fixed<16>(65'535)), 65'535.0);
  EXPECT_GT((Fixed<31>(1) * Fixed<16>(65'535)).raw(), 0);
}

TEST(Fixed, MultipliesAndDividesByWholeNumbers) {
  EXPECT_EQ(Fixed<16>(2.5) * 3, Fixed<16>(7.5));
  EXPECT_EQ(-3 * Fixed<16>(2.5), Fixed<16>(-7.5));
  EXPECT_EQ(Fixed<16>(7.5) / 3, Fixed<16>(2.5));
  EXPECT_EQ(Fixed<16>::from_raw(5) / 2, Fixed<16>::from_raw(2));
  EXPECT_EQ(Fixed<16>::from_raw(-5) / 2, Fixed<16>::from_raw(-2));  // towards zero
}

TEST(Fixed, FloorsTowardsMinusInfinity) {
  EXPECT_EQ(Fixed<16>(2.75).floor(), 2);
  EXPECT_EQ(Fixed<16>(-2.25).floor(), -3);
  EXPECT_EQ(Fixed<16>(-2).floor(), -2);
  EXPECT_EQ(Fixed<16>::from_raw(-1).floor(), -1);
}

TEST(WholeSquareRoot, IsTheLargestWhoseSquareFits) {
  EXPECT_EQ(whole_square_root(0), 0U);
  EXPECT_EQ(whole_square_root(1), 1U);
  EXPECT_EQ(whole_square_root(3), 1U);
  EXPECT_EQ(whole_square_root(~std::uint64_t{0}), 0xFFFFFFFFU);
  std::mt19937_64 random(65);
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t n = random() >> (32U + random() % 31U);
    ASSERT_EQ(whole_square_root(n * n), n);
    ASSERT_EQ(whole_square_root(n * n + 2 * n), n);  // one less than the next square
    if (n > 0) {
      ASSERT_EQ(whole_square_root(n * n - 1), n - 1);
    }
  }
}

// --- what scalar.hpp promises of the build's own numbers

TEST(Mass, SumsExactlyInAnyOrder) {
  std::mt19937_64 random(66);
  std::uniform_real_distribution<double> part(0.0, 2e-6);
  std::vector<Mass> masses;
  for (int i = 0; i < 100'000; ++i) {
    masses.push_back(mass_from(part(random)));
  }
  Mass sum{};
  for (const Mass m : masses) {
    sum += m;
  }
  for (int i = 0; i < 5; ++i) {
    std::shuffle(masses.begin(), masses.end(), random);
    Mass again{};
    for (const Mass m : masses) {
      again += m;
    }
    ASSERT_EQ(again, sum);
    Mass left = sum;
    for (const Mass m : masses) {
      left -= m;
    }
    ASSERT_EQ(left, Mass{});
  }
}

TEST(Mass, OfACellIsTheNearestUnit) {
  for (const double p : {0.0, 1.0, 0.5, 1.0 / 3, 1e-6, 1.0 / 25'600}) {
    EXPECT_LE(std::abs(to_double(mass_from(p)) - p), 0.5 * kMassUnit);
  }
  EXPECT_EQ(mass_from(0.4 * kMassUnit), Mass{});
  EXPECT_EQ(to_double(mass_from(0.6 * kMassUnit)), kMassUnit);
}

TEST(AfterPoints, IsLateByNothingAndEarlyByLessThanABitOfSeconds) {
  std::mt19937_64 random(67);
  std::uniform_real_distribution<double> seconds(0.01, 1250.0);  // a sight point: half a cell at the least speed
  for (int i = 0; i < 10'000; ++i) {
    const Pace pace(seconds(random));
    const int points = static_cast<int>(random() % 1024);
    const double exact = to_double(pace) * points;
    const double error = exact - to_double(after_points(pace, points));
    ASSERT_GE(error, kFixedPoint ? 0.0 : -1e-9);
    ASSERT_LT(error, 0x1p-16);
  }
}

TEST(MassTimeOf, CountsATimeInFullOrAsTheLongestThatThereIsRangeFor) {
  EXPECT_EQ(to_double(mass_time(Mass(1), Seconds(kLongest_s))), kLongest_s);
  EXPECT_EQ(to_double(mass_time(Mass(0.25), Seconds(100.5))), 25.125);
  for (const double late_s : {kLongest_s + 1.0, 65'536.0, 1e9}) {
    EXPECT_EQ(to_double(mass_time(Mass(1), Seconds(late_s))), kFixedPoint ? kLongest_s : late_s);
  }
  EXPECT_EQ(to_double(mass_time<kLongestJudged_s>(Mass(1), Seconds(17'000))), kFixedPoint ? kLongestJudged_s : 17'000);
  EXPECT_GT(mass_time(Mass(1.004), Seconds(1e9)), MassTime{});  // the cells' rounding
  const MassTime longest = mass_time<kLongestJudged_s>(Mass(1.004), Seconds(1e9));
  EXPECT_GT(longest + longest * 2 + longest / 2, longest);  // with the fine
}

TEST(StepOfFixed, IsTheFormulaWithAMarginOfTwoBits) {
  std::mt19937_64 random(68);
  for (int i = 0; i < 50'000; ++i) {
    const std::int64_t raw = i % 2 == 0 ? static_cast<std::int64_t>(random() % (std::uint64_t{5000} << 16U))
                                        : (static_cast<std::int64_t>(random() % 5000) << 16) + i % 9 - 4;
    const auto time_s = Fixed<16>::from_raw(raw);
    const double shifted = static_cast<double>(raw - 2) * 0x1p-16;
    ASSERT_EQ(step_of(time_s), std::max(0, static_cast<int>(std::ceil(shifted)))) << raw;
  }
  EXPECT_EQ(step_of(Fixed<16>(0)), 0);
  EXPECT_EQ(step_of(Fixed<16>(-3)), 0);
  EXPECT_EQ(step_of(Fixed<16>(1'000'000'000)), 1'000'000'000);
}

}  // namespace
}  // namespace ivo::planner
