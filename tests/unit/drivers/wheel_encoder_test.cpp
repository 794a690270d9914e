#include "drivers/wheel_encoder.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "config/rates.hpp"

namespace ivo::drivers {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

DriveParameters drive(int sign = 1, double gear = 1.0) {
  DriveParameters parameters;
  parameters.counts_per_turn = 1000.0;
  parameters.gear_ratio = gear;
  parameters.sign = sign;
  return parameters;
}

Instant cycle(int n) { return Instant(n * rates::kCycle); }

TEST(WheelEncoder, StartsAtZeroWhereverTheDriveStands) {
  WheelEncoder encoder(drive());
  encoder.sample(123456, cycle(0));
  EXPECT_EQ(encoder.angle_rad(), 0.0);
  EXPECT_EQ(encoder.radps(), 0.0);
}

TEST(WheelEncoder, CountsThroughTheWrapBothWays) {
  WheelEncoder encoder(drive());
  encoder.sample(std::numeric_limits<std::int32_t>::max() - 100, cycle(0));
  encoder.sample(std::numeric_limits<std::int32_t>::min() + 899, cycle(1));
  EXPECT_DOUBLE_EQ(encoder.angle_rad(), kTurn);
  encoder.sample(std::numeric_limits<std::int32_t>::max() - 100, cycle(2));
  EXPECT_DOUBLE_EQ(encoder.angle_rad(), 0.0);
}

TEST(WheelEncoder, IsAtTheWheelAfterGearAndSign) {
  WheelEncoder encoder(drive(-1, 4.0));
  encoder.sample(0, cycle(0));
  encoder.sample(1000, cycle(1));
  EXPECT_DOUBLE_EQ(encoder.angle_rad(), -kTurn / 4.0);
  EXPECT_DOUBLE_EQ(encoder.radps(), -kTurn / 4.0 / 0.002);
}

TEST(WheelEncoder, LosesNoDistanceAndNoSpeedWithALostSample) {
  WheelEncoder whole(drive());
  WheelEncoder lossy(drive());
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
  WheelEncoder encoder(drive());
  const int dwell = static_cast<int>(rates::kStandstillDwell / rates::kCycle);
  for (int n = 0; n < dwell; ++n) {
    encoder.sample(n % 2, cycle(n));
    EXPECT_FALSE(encoder.still());
  }
  encoder.sample(0, cycle(dwell));
  EXPECT_TRUE(encoder.still());
  encoder.sample(2, cycle(dwell + 1));
  EXPECT_FALSE(encoder.still());
}

TEST(WheelEncoder, CreepingIsNotRest) {
  WheelEncoder encoder(drive());
  for (int n = 0; n < 200; ++n) {
    encoder.sample(n / 5, cycle(n));
    EXPECT_FALSE(encoder.still());
  }
}

TEST(WheelEncoder, KeepsItsAngleWhenTheDriveCountsFromAnew) {
  WheelEncoder encoder(drive());
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
