#include "drivers/wheel_encoder.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "config/rates.hpp"

namespace ivo::drivers {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kRadiusM = 0.10;
constexpr int kDwell = static_cast<int>(rates::kStandstillDwell / rates::kCycle);

DriveParameters drive(int sign = 1, double gear = 1.0, double counts_per_turn = 1000.0) {
  DriveParameters parameters;
  parameters.counts_per_turn = counts_per_turn;
  parameters.gear_ratio = gear;
  parameters.sign = sign;
  return parameters;
}

Instant cycle(int n) { return Instant(n * rates::kCycle); }

TEST(WheelEncoder, StartsAtZeroWhereverTheDriveStands) {
  WheelEncoder encoder(drive(), kRadiusM);
  encoder.sample(123456, cycle(0));
  EXPECT_EQ(encoder.angle_rad(), 0.0);
  EXPECT_EQ(encoder.radps(), 0.0);
}

TEST(WheelEncoder, CountsThroughTheWrapBothWays) {
  WheelEncoder encoder(drive(), kRadiusM);
  encoder.sample(std::numeric_limits<std::int32_t>::max() - 100, cycle(0));
  encoder.sample(std::numeric_limits<std::int32_t>::min() + 899, cycle(1));
  EXPECT_DOUBLE_EQ(encoder.angle_rad(), kTurn);
  encoder.sample(std::numeric_limits<std::int32_t>::max() - 100, cycle(2));
  EXPECT_DOUBLE_EQ(encoder.angle_rad(), 0.0);
}

TEST(WheelEncoder, IsAtTheWheelAfterGearAndSign) {
  WheelEncoder encoder(drive(-1, 4.0), kRadiusM);
  encoder.sample(0, cycle(0));
  encoder.sample(1000, cycle(1));
  EXPECT_DOUBLE_EQ(encoder.angle_rad(), -kTurn / 4.0);
  EXPECT_DOUBLE_EQ(encoder.radps(), -kTurn / 4.0 / 0.002);
}

TEST(WheelEncoder, LosesNoDistanceAndNoSpeedWithALostSample) {
  WheelEncoder whole(drive(), kRadiusM);
  WheelEncoder lossy(drive(), kRadiusM);
  for (int n = 0; n <= 20; ++n) {
    whole.sample(10 * n, cycle(n));
    if (n % 3 != 1) {
      lossy.sample(10 * n, cycle(n));
    }
  }
  EXPECT_DOUBLE_EQ(lossy.angle_rad(), whole.angle_rad());
  EXPECT_DOUBLE_EQ(lossy.radps(), whole.radps());
  EXPECT_NEAR(whole.radps(), 0.010 * kTurn / 0.002, 1e-9);
}

TEST(WheelEncoder, RestsOnlyAfterTheDwellAndForgivesOneCount) {
  WheelEncoder encoder(drive(), kRadiusM);
  for (int n = 0; n < kDwell; ++n) {
    encoder.sample(n % 2, cycle(n));
    EXPECT_FALSE(encoder.still());
  }
  encoder.sample(0, cycle(kDwell));
  EXPECT_TRUE(encoder.still());
  encoder.sample(4, cycle(kDwell + 1));
  EXPECT_FALSE(encoder.still()) << "2.5 mm at the rim";
}

/// How many of 500 cycles, the dwell not counted, are at rest when `position` is counted.
template <class Position>
int cycles_at_rest(double counts_per_turn, const Position& position) {
  WheelEncoder encoder(drive(1, 1.0, counts_per_turn), kRadiusM);
  int at_rest = 0;
  for (int n = 0; n < kDwell + 500; ++n) {
    encoder.sample(position(n), cycle(n));
    at_rest += n >= kDwell && encoder.still() ? 1 : 0;
  }
  return at_rest;
}

std::int32_t counts_at(double speed_mps, double counts_per_turn, int n) {
  return static_cast<std::int32_t>(speed_mps * 0.002 * n / (kTurn * kRadiusM) * counts_per_turn);
}

TEST(WheelEncoder, ACoarseEncoderRestsWhileItFlickersByOneCountAndNotByTwo) {
  EXPECT_EQ(cycles_at_rest(64, [](int n) { return n % 2; }), 500);
  EXPECT_EQ(cycles_at_rest(64, [](int n) { return n % 3; }), 0);
}

TEST(WheelEncoder, AFineEncoderRestsWhileItShivers) {
  std::uint32_t random = 12345;
  const auto shiver = [&random](int) {
    random = random * 1664525U + 1013904223U;
    return static_cast<std::int32_t>(random >> 24) - 128;
  };
  EXPECT_EQ(cycles_at_rest(1 << 20, shiver), 500) << "0.15 mm at the rim";
}

TEST(WheelEncoder, AShiverOfMoreThanTheSpanIsNotRest) {
  EXPECT_EQ(cycles_at_rest(1 << 20, [](int n) { return n % 2 * 4000; }), 0) << "2.4 mm at the rim";
}

TEST(WheelEncoder, CreepingIsJudgedAlikeByAllEncodersThatSeeIt) {
  for (const double counts : {4096.0, 65536.0, 1048576.0}) {
    EXPECT_EQ(cycles_at_rest(counts, [&](int n) { return counts_at(0.020, counts, n); }), 0) << counts;
    EXPECT_EQ(cycles_at_rest(counts, [&](int n) { return counts_at(0.005, counts, n); }), 500) << counts;
  }
}

TEST(WheelEncoder, ADwellWithLostSamplesCountsAndATooShortOneDoesNot) {
  WheelEncoder encoder(drive(), kRadiusM);
  encoder.sample(0, cycle(0));
  encoder.sample(0, cycle(kDwell - 1));
  EXPECT_FALSE(encoder.still());
  encoder.sample(0, cycle(kDwell + 3));
  EXPECT_TRUE(encoder.still());
}

TEST(WheelEncoder, CreepingIsNotRest) {
  WheelEncoder encoder(drive(), kRadiusM);
  for (int n = 0; n < 200; ++n) {
    encoder.sample(n / 5, cycle(n));
    EXPECT_FALSE(encoder.still());
  }
}

TEST(WheelEncoder, KeepsItsAngleWhenTheDriveCountsFromAnew) {
  WheelEncoder encoder(drive(), kRadiusM);
  encoder.sample(0, cycle(0));
  encoder.sample(500, cycle(1));
  encoder.rebase();
  encoder.sample(0, cycle(2));
  EXPECT_DOUBLE_EQ(encoder.angle_rad(), kTurn / 2.0);
  EXPECT_EQ(encoder.radps(), 0.0);
  EXPECT_FALSE(encoder.still());
}

}  // namespace
}  // namespace ivo::drivers
