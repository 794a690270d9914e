#include "firmware/motion/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ivo::firmware {
namespace {

constexpr double kExact = 1e-12;

BaseParameters base_of(WheelGeometry geometry) {
  BaseParameters base;
  base.geometry = geometry;
  base.wheel_radius_m = 0.10;
  base.half_length_m = 0.20;
  base.half_width_m = 0.15;
  base.max_wheel_radps = 10.0;
  return base;
}

BaseParameters square_omni() {
  BaseParameters base = base_of(WheelGeometry::kOmniX);
  base.half_length_m = 0.2;
  base.half_width_m = 0.2;
  return base;
}

void expect_wheels(const WheelValues& w, double fl, double fr, double rl, double rr) {
  EXPECT_NEAR(w[0], fl, kExact) << "front left";
  EXPECT_NEAR(w[1], fr, kExact) << "front right";
  EXPECT_NEAR(w[2], rl, kExact) << "rear left";
  EXPECT_NEAR(w[3], rr, kExact) << "rear right";
}

TEST(MecanumKinematics, DrivesAllWheelsAlikeStraightAhead) {
  expect_wheels(Kinematics(base_of(WheelGeometry::kMecanum)).wheel_speeds({0.5, 0, 0}), 5, 5, 5, 5);
}

TEST(MecanumKinematics, CrossesTheWheelsToGoLeft) {
  expect_wheels(Kinematics(base_of(WheelGeometry::kMecanum)).wheel_speeds({0, 0.3, 0}), -3, 3, 3, -3);
}

TEST(MecanumKinematics, DrivesTheRightSideAheadToTurnLeft) {
  expect_wheels(Kinematics(base_of(WheelGeometry::kMecanum)).wheel_speeds({0, 0, 1}), -3.5, 3.5, -3.5, 3.5);
}

TEST(MecanumKinematics, AddsWhatItIsAskedFor) {
  // FL 5 - 3 - 3.5, FR 5 + 3 + 3.5, RL 5 + 3 - 3.5, RR 5 - 3 + 3.5.
  expect_wheels(Kinematics(base_of(WheelGeometry::kMecanum)).wheel_speeds({0.5, 0.3, 1}), -1.5, 11.5, 4.5, 5.5);
}

TEST(OmniKinematics, NeedsLessWheelSpeedThanMecanumStraightAhead) {
  const double w = 5.0 / std::sqrt(2.0);
  expect_wheels(Kinematics(square_omni()).wheel_speeds({0.5, 0, 0}), w, w, w, w);
}

TEST(OmniKinematics, CrossesTheWheelsToGoLeft) {
  const double w = 3.0 / std::sqrt(2.0);
  expect_wheels(Kinematics(square_omni()).wheel_speeds({0, 0.3, 0}), -w, w, w, -w);
}

TEST(OmniKinematics, TurnsLeftWithPositiveWheelsOnTheRight) {
  const double w = 2.0 * std::sqrt(2.0);
  expect_wheels(Kinematics(square_omni()).wheel_speeds({0, 0, 1}), -w, w, -w, w);
}

TEST(OmniKinematics, FollowsTheDiagonalsOfAnOblongBase) {
  // lx 0.20, ly 0.15, R 0.25: the front left wheel drives along (0.6, -0.8).
  const Kinematics kinematics(base_of(WheelGeometry::kOmniX));
  expect_wheels(kinematics.wheel_speeds({1, 0, 0}), 6, 6, 6, 6);
  expect_wheels(kinematics.wheel_speeds({0, 1, 0}), -8, 8, 8, -8);
  expect_wheels(kinematics.wheel_speeds({0, 0, 1}), -2.5, 2.5, -2.5, 2.5);
}

class BothGeometries : public testing::TestWithParam<WheelGeometry> {};
INSTANTIATE_TEST_SUITE_P(Kinematics, BothGeometries, testing::Values(WheelGeometry::kMecanum, WheelGeometry::kOmniX));

TEST_P(BothGeometries, GiveTheTwistBackFromItsWheels) {
  const Kinematics kinematics(base_of(GetParam()));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int i = 0; i < 1000; ++i) {
    const Twist sent{any(random), any(random), any(random)};
    const WheelValues wheels = kinematics.wheel_speeds(sent);
    const Twist back = kinematics.twist(wheels);
    ASSERT_NEAR(back.vx_mps, sent.vx_mps, kExact);
    ASSERT_NEAR(back.vy_mps, sent.vy_mps, kExact);
    ASSERT_NEAR(back.wz_radps, sent.wz_radps, kExact);
    ASSERT_NEAR(kinematics.slip_residual_mps(wheels), 0.0, kExact);
  }
}

TEST_P(BothGeometries, FitAnyWheelSpeedsBestInLeastSquares) {
  const Kinematics kinematics(base_of(GetParam()));
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> any(-10.0, 10.0);
  for (int i = 0; i < 100; ++i) {
    const WheelValues measured{any(random), any(random), any(random), any(random)};
    const WheelValues fitted = kinematics.wheel_speeds(kinematics.twist(measured));
    // What is left over must be a multiple of the left-null vector (1, 1, -1, -1) / 2, by the slip residual.
    const double residual_radps = kinematics.slip_residual_mps(measured) / 0.10;
    const WheelValues null{0.5, 0.5, -0.5, -0.5};
    for (std::size_t w = 0; w < kWheels; ++w) {
      ASSERT_NEAR(measured[w] - fitted[w], residual_radps * null[w], 1e-9);
    }
  }
}

TEST_P(BothGeometries, SeeOneSlippingWheelInTheResidual) {
  const Kinematics kinematics(base_of(GetParam()));
  WheelValues wheels = kinematics.wheel_speeds({0.4, 0.1, 0.2});
  wheels[2] += 2.0;
  EXPECT_NEAR(kinematics.slip_residual_mps(wheels), -0.10, kExact);
}

TEST_P(BothGeometries, ScaleTheWholeTwistToTheFastestWheel) {
  const Kinematics kinematics(base_of(GetParam()));
  const Twist wanted{2.0, -1.0, 3.0};
  const double scale = kinematics.saturation(kinematics.wheel_speeds(wanted));
  ASSERT_GT(scale, 0.0);
  ASSERT_LT(scale, 1.0);
  double fastest = 0;
  for (const double w :
       kinematics.wheel_speeds({wanted.vx_mps * scale, wanted.vy_mps * scale, wanted.wz_radps * scale})) {
    fastest = std::max(fastest, std::abs(w));
  }
  EXPECT_NEAR(fastest, 10.0, 1e-9);
}

TEST_P(BothGeometries, LeaveAloneWhatTheWheelsCanDo) {
  EXPECT_EQ(Kinematics(base_of(GetParam())).saturation({10, -10, 0, 3}), 1.0);
}

TEST_P(BothGeometries, AllowNothingForWheelSpeedsThatAreNotNumbers) {
  const Kinematics kinematics(base_of(GetParam()));
  EXPECT_EQ(kinematics.saturation({1, std::nan(""), 1, 1}), 0.0);
  EXPECT_EQ(kinematics.saturation({1, 1, 1, -std::numeric_limits<double>::infinity()}), 0.0);
}

TEST_P(BothGeometries, TurnByTheCalibratedLeverArmAndMoveAsBefore) {
  BaseParameters base = base_of(GetParam());
  const Kinematics drawn(base);
  base.turn_scale = 1.2;
  const Kinematics calibrated(base);
  for (std::size_t i = 0; i < kWheels; ++i) {
    EXPECT_NEAR(calibrated.wheel_speeds({0, 0, 1})[i], 1.2 * drawn.wheel_speeds({0, 0, 1})[i], kExact);
    EXPECT_NEAR(calibrated.wheel_speeds({0.3, -0.2, 0})[i], drawn.wheel_speeds({0.3, -0.2, 0})[i], kExact);
  }
  // As the header says to calibrate: wheels that odometry of the drawing takes for 1.2 rad have made 1 rad.
  const WheelValues turned = calibrated.wheel_speeds({0, 0, 1});
  EXPECT_NEAR(drawn.twist(turned).wz_radps, 1.2, kExact);
  EXPECT_NEAR(calibrated.twist(turned).wz_radps, 1.0, kExact);
}

TEST_P(BothGeometries, HaveTheLeftNullVectorOfAllMotions) {
  // (FL, FR, RR, RL) = (1, 1, -1, -1), told column by column, so that a wrong sign in one cannot hide in another.
  const Kinematics kinematics(base_of(GetParam()));
  for (const Twist& twist : {Twist{1, 0, 0}, Twist{0, 1, 0}, Twist{0, 0, 1}}) {
    const auto [fl, fr, rl, rr] = kinematics.wheel_speeds(twist);
    EXPECT_NEAR(fl + fr - rr - rl, 0.0, kExact);
    EXPECT_GT(std::abs(fl), 0.1);
  }
}

TEST(KinematicsDeathTest, BreaksOnABaseWithoutWheels) {
  BaseParameters base;
  base.wheel_radius_m = 0.0;
  EXPECT_DEATH(Kinematics{base}, "");
  base = {};
  base.turn_scale = 0.0;
  EXPECT_DEATH(Kinematics{base}, "");
}

}  // namespace
}  // namespace ivo::firmware
