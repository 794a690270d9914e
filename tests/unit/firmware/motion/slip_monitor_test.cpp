#include "firmware/motion/slip_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ivo::firmware {
namespace {

constexpr double kRadius_m = 0.10;
const SlipParameters kParameters{.wheel_sigma_mps = 0.01, .share = 0.04, .limit_sigma = 6.0, .cycles = 10};

BaseParameters slipping_base(WheelGeometry geometry) {
  BaseParameters base;
  base.geometry = geometry;
  base.wheel_radius_m = kRadius_m;
  return base;
}

class SlipMonitorOf : public testing::TestWithParam<WheelGeometry> {
 protected:
  Kinematics kinematics_{slipping_base(GetParam())};
  SlipMonitor monitor_{kinematics_, kRadius_m, kParameters};
};
INSTANTIATE_TEST_SUITE_P(BothGeometries, SlipMonitorOf,
                         testing::Values(WheelGeometry::kMecanum, WheelGeometry::kOmniX));

TEST_P(SlipMonitorOf, HasAResidualOfOneSigmaFromWheelsOfOneSigma) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  const WheelValues speeds = kinematics_.wheel_speeds({0.4, 0.1, -0.3});
  double sum = 0.0;
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    WheelValues noisy = speeds;
    for (double& speed : noisy) {
      speed += noise(random) / kRadius_m;
    }
    sum += std::pow(monitor_.update({.measured_radps = noisy, .commanded_radps = speeds}).residual_mps, 2);
  }
  EXPECT_NEAR(std::sqrt(sum / kDraws), 0.02, 0.0005);
}

TEST_P(SlipMonitorOf, GrowsMoreTolerantWithSpeed) {
  EXPECT_NEAR(monitor_.update({}).sigma_mps, 0.01, 1e-12);
  const WheelValues speeds{5.0, -5.0, -5.0, 5.0};
  EXPECT_NEAR(monitor_.update({.measured_radps = speeds, .commanded_radps = speeds}).sigma_mps, std::hypot(0.01, 0.02),
              1e-12);
}

TEST_P(SlipMonitorOf, NamesTheWheelThatAloneIsOff) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    for (int i = 0; i < 100; ++i) {
      const WheelValues told = kinematics_.wheel_speeds({any(random), any(random), any(random)});
      WheelValues measured = told;
      const double off_mps = std::copysign(0.3, any(random));
      measured[wheel] += off_mps / kRadius_m;
      const SlipHealth& health = monitor_.update({.measured_radps = measured, .commanded_radps = told});
      ASSERT_EQ(health.suspect, static_cast<Wheel>(wheel));
      ASSERT_NEAR(health.off_mps[wheel], off_mps, 1e-12);
    }
  }
}

TEST_P(SlipMonitorOf, IsSlipAfterSoManyCyclesInARowAndNotBefore) {
  WheelValues slipping{};
  slipping[1] = 0.13 / kRadius_m;  // residual 0.065, of sigmas sqrt(0.01^2 + (0.04 0.13)^2) = 0.01127: 5.77
  for (int i = 0; i < 100; ++i) {
    ASSERT_FALSE(monitor_.update({.measured_radps = slipping}).slipping);
  }
  slipping[1] = 0.14 / kRadius_m;  // 6.11
  for (int i = 1; i < kParameters.cycles; ++i) {
    ASSERT_FALSE(monitor_.update({.measured_radps = slipping}).slipping);
  }
  EXPECT_FALSE(monitor_.update({}).slipping) << "one good cycle begins the count anew";
  for (int i = 1; i < kParameters.cycles; ++i) {
    ASSERT_FALSE(monitor_.update({.measured_radps = slipping}).slipping);
  }
  EXPECT_TRUE(monitor_.update({.measured_radps = slipping}).slipping);
  monitor_.reset();
  EXPECT_FALSE(monitor_.health().slipping);
}

TEST_P(SlipMonitorOf, LeavesOutWhatIsExplained) {
  WheelValues measured{};
  measured[3] = 0.4 / kRadius_m;
  EXPECT_EQ(monitor_.update({.measured_radps = measured, .explained_mps = 0.2}).normalised, 0.0);
  EXPECT_GT(monitor_.update({.measured_radps = measured, .explained_mps = 0.05}).normalised, kParameters.limit_sigma);
}

TEST_P(SlipMonitorOf, TakesASpeedThatIsNotANumberForSlip) {
  WheelValues broken{};
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    monitor_.reset();
    broken[2] = bad;
    for (int i = 0; i < kParameters.cycles; ++i) {
      monitor_.update({.measured_radps = broken});
    }
    EXPECT_TRUE(monitor_.health().slipping);
  }
}

TEST(SlipMonitorDeathTest, BreaksWithoutAnyTolerance) {
  const Kinematics kinematics(slipping_base(WheelGeometry::kMecanum));
  EXPECT_DEATH(SlipMonitor(kinematics, kRadius_m, {.wheel_sigma_mps = 0.0}), "");
  EXPECT_DEATH(SlipMonitor(kinematics, kRadius_m, {.cycles = 0}), "");
}

}  // namespace
}  // namespace ivo::firmware
