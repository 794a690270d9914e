#include "firmware/motion/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "firmware/motion/arc.hpp"

namespace ivo::firmware {
namespace {

using std::numbers::pi;
constexpr double kStep_s = 0.002;

/// Wheels that turn as a twist says, without slip.
class PerfectWheels {
 public:
  explicit PerfectWheels(const Kinematics& kinematics) : kinematics_(kinematics) {}
  const WheelValues& turn(const Twist& twist, double dt_s) {
    const WheelValues speeds = kinematics_.wheel_speeds(twist);
    for (std::size_t i = 0; i < kWheels; ++i) {
      angles_rad_[i] += speeds[i] * dt_s;
    }
    return angles_rad_;
  }
  const WheelValues& angles_rad() const { return angles_rad_; }

 private:
  Kinematics kinematics_;
  WheelValues angles_rad_{100.0, -50.0, 3.0, 7.0};
};

class OdometryOf : public testing::TestWithParam<WheelGeometry> {
 protected:
  OdometryOf() {
    odometry_.reset({1.0, 2.0, 0.0});
    odometry_.update(wheels_.angles_rad());
  }
  void drive(const Twist& twist, double for_s, double step_s = kStep_s) {
    const int steps = static_cast<int>(std::lround(for_s / step_s));
    for (int i = 0; i < steps; ++i) {
      ASSERT_TRUE(odometry_.update(wheels_.turn(twist, for_s / steps)));
    }
  }
  void expect_pose(double x_m, double y_m, double heading_rad) const {
    EXPECT_NEAR(odometry_.pose().x_m, x_m, 1e-9);
    EXPECT_NEAR(odometry_.pose().y_m, y_m, 1e-9);
    EXPECT_NEAR(std::remainder(odometry_.pose().heading_rad - heading_rad, 2 * pi), 0.0, 1e-9);
  }
  static BaseParameters base() {
    BaseParameters base;
    base.geometry = GetParam();
    return base;
  }
  Kinematics kinematics_{base()};
  PerfectWheels wheels_{kinematics_};
  Odometry odometry_{kinematics_};
};
INSTANTIATE_TEST_SUITE_P(BothGeometries, OdometryOf, testing::Values(WheelGeometry::kMecanum, WheelGeometry::kOmniX));

TEST_P(OdometryOf, AFirstReadingMovesNothing) { expect_pose(1.0, 2.0, 0.0); }

TEST_P(OdometryOf, ASquareWithHeldHeadingEndsWhereItBegan) {
  drive({0.5, 0, 0}, 4);
  expect_pose(3.0, 2.0, 0.0);
  drive({0, 0.5, 0}, 4);
  expect_pose(3.0, 4.0, 0.0);
  drive({-0.5, 0, 0}, 4);
  drive({0, -0.5, 0}, 4);
  expect_pose(1.0, 2.0, 0.0);
}

TEST_P(OdometryOf, ASquareWithTurnsOnTheSpotEndsWhereItBegan) {
  for (int side = 0; side < 4; ++side) {
    drive({0.5, 0, 0}, 2);
    drive({0, 0, pi / 4}, 2);
  }
  expect_pose(1.0, 2.0, 0.0);
}

TEST_P(OdometryOf, ACircleIsExactHoweverFewReadingsItHas) {
  // Radius 0.5 to the left: the centre is (1, 2.5), half the circle ends at (1, 3).
  drive({0.5, 0, 1.0}, pi, pi / 2);
  expect_pose(1.0, 3.0, pi);
  drive({0.5, 0, 1.0}, pi, pi / 2);
  expect_pose(1.0, 2.0, 0.0);
}

TEST_P(OdometryOf, ACircleAtTheLoopsRateIsExact) {
  drive({0.3, 0.4, -0.8}, 2 * pi / 0.8);
  expect_pose(1.0, 2.0, 0.0);
}

TEST_P(OdometryOf, AMissedCycleLosesNothing) {
  drive({0.4, -0.2, 0.5}, 0.5);
  wheels_.turn({0.4, -0.2, 0.5}, kStep_s);
  wheels_.turn({0.4, -0.2, 0.5}, kStep_s);
  drive({0.4, -0.2, 0.5}, 0.5);
  const Pose all_at_once = advance({1.0, 2.0, 0.0}, {0.4, -0.2, 0.5}, 1.0 + 2 * kStep_s);
  expect_pose(all_at_once.x_m, all_at_once.y_m, all_at_once.heading_rad);
}

TEST_P(OdometryOf, AReadingThatIsNotANumberIsRefusedAndTheNextMakesUpForIt) {
  WheelValues broken = wheels_.turn({0.5, 0, 0}, 1.0);
  broken[1] = std::nan("");
  EXPECT_FALSE(odometry_.update(broken));
  expect_pose(1.0, 2.0, 0.0);
  broken[1] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(odometry_.update(broken));
  drive({0.5, 0, 0}, 1.0);
  expect_pose(2.0, 2.0, 0.0);
}

TEST_P(OdometryOf, AResetForgetsWhatTheWheelsDidBefore) {
  odometry_.reset({5.0, 5.0, pi / 2});
  wheels_.turn({1.0, 0, 0}, 10.0);
  odometry_.update(wheels_.angles_rad());
  expect_pose(5.0, 5.0, pi / 2);
  drive({0.5, 0, 0}, 2.0);
  expect_pose(5.0, 6.0, pi / 2);
}

TEST_P(OdometryOf, SaysWhatTheLastReadingMoved) {
  EXPECT_EQ(odometry_.moved().vx_mps, 0.0) << "a first reading moves nothing";
  odometry_.update(wheels_.turn({0.5, -0.2, 0.8}, 0.1));
  EXPECT_NEAR(odometry_.moved().vx_mps, 0.05, 1e-12);
  EXPECT_NEAR(odometry_.moved().vy_mps, -0.02, 1e-12);
  EXPECT_NEAR(odometry_.moved().wz_radps, 0.08, 1e-12);
  WheelValues broken = wheels_.turn({0.5, 0, 0}, 0.1);
  broken[3] = std::nan("");
  odometry_.update(broken);
  EXPECT_EQ(odometry_.moved().vx_mps, 0.0) << "nor does one that is refused";
}

TEST(Arc, AgreesOnBothSidesOfTheSeries) {
  // The series and the quotient meet at a half turn of 1e-4.
  const Pose below = advance({}, {1.0, 0.5, 1.9999999e-4}, 1.0);
  const Pose above = advance({}, {1.0, 0.5, 2.0000001e-4}, 1.0);
  EXPECT_NEAR(below.x_m, above.x_m, 1e-10);
  EXPECT_NEAR(below.y_m, above.y_m, 1e-10);
}

TEST(Arc, IsAStraightLineWithoutTurn) {
  const Pose there = advance({1, 1, pi / 2}, {2.0, 1.0, 0.0}, 0.5);
  EXPECT_NEAR(there.x_m, 0.5, 1e-15);
  EXPECT_NEAR(there.y_m, 2.0, 1e-15);
}

TEST(Arc, KeepsTheHeadingWithinHalfATurn) {
  EXPECT_NEAR(advance({0, 0, 3.0}, {0, 0, 1.0}, 1.0).heading_rad, 4.0 - 2 * pi, 1e-12);
}

}  // namespace
}  // namespace ivo::firmware
