#include "firmware/motion/pose_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "config/rates.hpp"
#include "firmware/motion/arc.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""us;
using std::chrono_literals::operator""ns;
using std::chrono_literals::operator""s;

using std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Instant kStart{10s};
const PoseCovariance kUnsure = covariance_of(0.1, 0.1, 0.05);

double between(double a_rad, double b_rad) { return std::remainder(a_rad - b_rad, 2 * pi); }

void expect_same(const PoseFilter& a, const PoseFilter& b, double tolerance) {
  EXPECT_NEAR(a.pose().x_m, b.pose().x_m, tolerance);
  EXPECT_NEAR(a.pose().y_m, b.pose().y_m, tolerance);
  EXPECT_NEAR(between(a.pose().heading_rad, b.pose().heading_rad), 0.0, tolerance);
  EXPECT_LE((a.covariance() - b.covariance()).cwiseAbs().maxCoeff(), tolerance);
}

/// A filter that drives at a constant twist in steps of 2 ms.
class Driven {
 public:
  explicit Driven(const Pose& from = {}, const PoseCovariance& covariance = kUnsure) {
    EXPECT_EQ(filter.reset(from, covariance, now), PoseRefusal::kNone);
  }
  void drive(const Twist& twist, Duration time, Duration step = rates::kCycle) {
    for (const Instant end = now + time; now < end;) {
      now += step;
      const double dt_s = seconds(step);
      EXPECT_EQ(filter.predict({twist.vx_mps * dt_s, twist.vy_mps * dt_s, twist.wz_radps * dt_s}, now),
                PoseRefusal::kNone);
    }
  }
  PoseFilter filter;
  Instant now = kStart;
};

TEST(PoseFilter, WithoutOtherPosesGoesWhereOdometryGoes) {
  Driven robot({1.0, 2.0, 3.0});
  robot.drive({0.4, -0.2, 0.7}, 3s);
  const Pose there = advance({1.0, 2.0, 3.0}, {0.4, -0.2, 0.7}, 3.0);
  EXPECT_NEAR(robot.filter.pose().x_m, there.x_m, 1e-9);
  EXPECT_NEAR(robot.filter.pose().y_m, there.y_m, 1e-9);
  EXPECT_NEAR(between(robot.filter.pose().heading_rad, there.heading_rad), 0.0, 1e-9);
}

TEST(PoseFilter, GrowsUnsureWithTheWayAndTheTurnAndNotWithTime) {
  const OdometryNoise noise;
  Driven straight({}, PoseCovariance::Zero());
  straight.drive({0.5, 0, 0}, 4s);
  EXPECT_NEAR(straight.filter.covariance()(0, 0), 2 * noise.position_m2_per_m, 1e-12);
  EXPECT_NEAR(straight.filter.covariance()(2, 2), 2 * noise.heading_rad2_per_m, 1e-12);
  // Across the way the heading's error adds its integral: variance of heading a metre, times length cubed over 3.
  EXPECT_NEAR(straight.filter.covariance()(1, 1), 2 * noise.position_m2_per_m + noise.heading_rad2_per_m * 8.0 / 3.0,
              1e-6);
  Driven turning({}, PoseCovariance::Zero());
  turning.drive({0, 0, -0.5}, 4s);
  EXPECT_NEAR(turning.filter.covariance()(2, 2), 2 * noise.heading_rad2_per_rad, 1e-12);
  EXPECT_NEAR(turning.filter.covariance()(0, 0), 2 * noise.position_m2_per_rad, 1e-12);
  const PoseCovariance before = turning.filter.covariance();
  turning.drive({}, 60s);
  EXPECT_EQ(turning.filter.covariance(), before);
}

TEST(PoseFilter, IsNoSurerForDrivingInLongerSteps) {
  Driven fine;
  Driven coarse;
  fine.drive({0.5, 0.1, 0.3}, 2s, 1ms);
  coarse.drive({0.5, 0.1, 0.3}, 2s, 10ms);
  expect_same(fine.filter, coarse.filter, 1e-5);
}

TEST(PoseFilter, AgreesWithASumOfGaussiansByHand) {
  // At rest, one axis apart from the other: variance a b / (a + b), mean weighted by the inverse variances.
  Driven robot({}, covariance_of(0.3, 0.2, 0.1));
  robot.drive({}, 2ms);
  ASSERT_EQ(robot.filter.correct({{0.3, -0.1, 0.05}, covariance_of(0.1, 0.4, 0.1), robot.now}), PoseRefusal::kNone);
  EXPECT_NEAR(robot.filter.pose().x_m, 0.3 * 0.09 / (0.09 + 0.01), 1e-12);
  EXPECT_NEAR(robot.filter.pose().y_m, -0.1 * 0.04 / (0.04 + 0.16), 1e-12);
  EXPECT_NEAR(robot.filter.pose().heading_rad, 0.025, 1e-12);
  EXPECT_NEAR(robot.filter.covariance()(0, 0), 0.09 * 0.01 / 0.10, 1e-12);
  EXPECT_NEAR(robot.filter.covariance()(1, 1), 0.04 * 0.16 / 0.20, 1e-12);
}

TEST(PoseFilter, TakesTheShortWayRoundToAHeadingBeyondHalfATurn) {
  Driven robot({0, 0, pi - 0.02}, covariance_of(0.1, 0.1, 0.1));
  robot.drive({}, 2ms);
  ASSERT_EQ(robot.filter.correct({{0, 0, -pi + 0.02}, covariance_of(0.1, 0.1, 0.1), robot.now}), PoseRefusal::kNone);
  EXPECT_NEAR(std::abs(robot.filter.pose().heading_rad), pi, 1e-9);
  // Whole turns more or less are the same heading.
  ASSERT_EQ(robot.filter.correct({{0, 0, 7 * pi}, covariance_of(0.1, 0.1, 0.1), robot.now}), PoseRefusal::kNone);
  EXPECT_NEAR(std::abs(robot.filter.pose().heading_rad), pi, 1e-9);
}

TEST(PoseFilter, TakesALatePoseAtItsTimeAsIfItHadComeThen) {
  const Twist curve{0.5, 0.1, 0.8};
  for (const Duration late : {Duration(0ms), Duration(2ms), Duration(100ms), Duration(333ms), Duration(500ms)}) {
    Driven in_time;
    Driven delayed;
    in_time.drive(curve, 1s);
    const ExternalPose seen{{0.55, 0.4, 0.75}, covariance_of(0.05, 0.05, 0.02), in_time.now};
    ASSERT_EQ(in_time.filter.correct(seen), PoseRefusal::kNone);
    in_time.drive(curve, late);
    delayed.drive(curve, 1s + late);
    ASSERT_EQ(delayed.filter.correct(seen), PoseRefusal::kNone) << late.count();
    expect_same(in_time.filter, delayed.filter, 1e-12);
  }
}

TEST(PoseFilter, TakesAPoseBetweenTwoSteps) {
  Driven fine;
  Driven coarse;
  fine.drive({0.5, 0, 0.5}, 400ms, 1ms);
  coarse.drive({0.5, 0, 0.5}, 400ms, 4ms);
  const ExternalPose seen{{0.1, 0.02, 0.1}, covariance_of(0.02, 0.02, 0.02), kStart + 201ms};
  ASSERT_EQ(fine.filter.correct(seen), PoseRefusal::kNone);
  ASSERT_EQ(coarse.filter.correct(seen), PoseRefusal::kNone);
  expect_same(fine.filter, coarse.filter, 1e-6);
}

TEST(PoseFilter, DoesNotMindInWhichOrderPosesArrive) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0.0, 0.02);
  std::vector<ExternalPose> seen;
  for (int i = 0; i < 12; ++i) {
    const Duration when = 40ms * i + 700us * (i % 3) + 5ms;
    const Pose true_pose = advance({}, {0.6, 0, -0.4}, seconds(when));
    seen.push_back({{true_pose.x_m + noise(random), true_pose.y_m + noise(random), true_pose.heading_rad},
                    covariance_of(0.03, 0.03, 0.05),
                    kStart + when});
  }
  Driven in_order;
  in_order.drive({0.6, 0, -0.4}, 500ms);
  for (const ExternalPose& pose : seen) {
    ASSERT_EQ(in_order.filter.correct(pose), PoseRefusal::kNone);
  }
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(seen.begin(), seen.end(), random);
    Driven shuffled;
    shuffled.drive({0.6, 0, -0.4}, 500ms);
    for (const ExternalPose& pose : seen) {
      ASSERT_EQ(shuffled.filter.correct(pose), PoseRefusal::kNone);
    }
    expect_same(in_order.filter, shuffled.filter, 1e-12);
  }
}

// Noise of odometry and of poses as the filter believes it to be, poses 200 ms late: the error, in units of what the
// filter thinks of it, must be chi-square with three degrees of freedom.
TEST(PoseFilter, IsAsUnsureAsItIsWrong) {
  constexpr int kRuns = 100;
  constexpr int kLooks = 6;
  std::array<double, kLooks> nees{};
  double gate_sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    std::mt19937_64 random(1000 + static_cast<std::uint64_t>(run));
    std::normal_distribution<double> unit(0.0, 1.0);
    const OdometryNoise noise;
    const PoseCovariance seen_covariance = covariance_of(0.05, 0.08, 0.03);
    PoseFilter filter(noise);
    Pose truth;
    const Pose guess{0.1 * unit(random), 0.1 * unit(random), 0.05 * unit(random)};
    ASSERT_EQ(filter.reset(guess, kUnsure, kStart), PoseRefusal::kNone);
    std::vector<ExternalPose> on_the_way;
    Instant now = kStart;
    Twist twist;
    for (int cycle = 1; cycle <= kLooks * 500; ++cycle) {
      if (cycle % 250 == 1) {
        twist = {0.5 * unit(random), 0.3 * unit(random), 0.5 * unit(random)};
      }
      now += rates::kCycle;
      const Twist told{twist.vx_mps * 0.002, twist.vy_mps * 0.002, twist.wz_radps * 0.002};
      const double way = std::hypot(told.vx_mps, told.vy_mps);
      const double turn = std::abs(told.wz_radps);
      const double position = std::sqrt(noise.position_m2_per_m * way + noise.position_m2_per_rad * turn);
      const double heading = std::sqrt(noise.heading_rad2_per_m * way + noise.heading_rad2_per_rad * turn);
      truth = advance(truth,
                      {told.vx_mps + position * unit(random), told.vy_mps + position * unit(random),
                       told.wz_radps + heading * unit(random)},
                      1.0);
      ASSERT_EQ(filter.predict(told, now), PoseRefusal::kNone);
      if (cycle % 50 == 0) {
        on_the_way.push_back({{truth.x_m + 0.05 * unit(random), truth.y_m + 0.08 * unit(random),
                               truth.heading_rad + 0.03 * unit(random)},
                              seen_covariance,
                              now});
      }
      if (cycle % 50 == 0 && on_the_way.size() >= 3) {
        (void)filter.correct(on_the_way[on_the_way.size() - 3]);
        gate_sum += filter.last_distance2();
      }
      if (cycle % 500 == 0) {
        const Eigen::Vector3d error(filter.pose().x_m - truth.x_m, filter.pose().y_m - truth.y_m,
                                    between(filter.pose().heading_rad, truth.heading_rad));
        nees[static_cast<std::size_t>(cycle / 500 - 1)] += error.dot(filter.covariance().inverse() * error) / kRuns;
      }
    }
  }
  // 100 runs: chi-square of 300 degrees over 100, from its 0.01 % to its 99.99 % quantile.
  for (const double mean : nees) {
    EXPECT_GT(mean, 2.18);
    EXPECT_LT(mean, 3.99);
  }
  const double innovations = gate_sum / (kRuns * (kLooks * 10 - 2));
  EXPECT_NEAR(innovations, 3.0, 0.15);
}

TEST(PoseFilter, IsNearerToTheTruthThanOdometryAlone) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> unit(0.0, 1.0);
  Driven fused;
  Pose truth;
  Pose odometry;
  for (int cycle = 1; cycle <= 30'000; ++cycle) {
    fused.now += rates::kCycle;
    const Twist told{0.001, 0.0, 0.0004};
    truth = advance(truth, {0.00102, 0.0, 0.00041}, 1.0);  // wheels a little larger than they are thought to be
    odometry = advance(odometry, told, 1.0);
    ASSERT_EQ(fused.filter.predict(told, fused.now), PoseRefusal::kNone);
    if (cycle % 100 == 0) {
      (void)fused.filter.correct(
          {{truth.x_m + 0.03 * unit(random), truth.y_m + 0.03 * unit(random), truth.heading_rad + 0.02 * unit(random)},
           covariance_of(0.03, 0.03, 0.02),
           fused.now});
    }
  }
  const double fused_m = std::hypot(fused.filter.pose().x_m - truth.x_m, fused.filter.pose().y_m - truth.y_m);
  const double odometry_m = std::hypot(odometry.x_m - truth.x_m, odometry.y_m - truth.y_m);
  EXPECT_LT(fused_m, 0.05);
  EXPECT_GT(odometry_m, 0.10);
}

TEST(PoseFilter, RefusesAJumpAndSaysSo) {
  Driven robot;
  robot.drive({0.5, 0, 0}, 1s);
  const Pose before = robot.filter.pose();
  const ExternalPose jump{
      {before.x_m + 3.0, before.y_m, before.heading_rad}, covariance_of(0.05, 0.05, 0.05), robot.now};
  EXPECT_EQ(robot.filter.correct(jump), PoseRefusal::kTooFar);
  EXPECT_EQ(robot.filter.correct(jump), PoseRefusal::kTooFar);
  EXPECT_EQ(robot.filter.pose().x_m, before.x_m);
  EXPECT_EQ(robot.filter.refused(PoseRefusal::kTooFar), 2U);
  EXPECT_EQ(robot.filter.jumps_in_a_row(), 2U);
  EXPECT_GT(robot.filter.last_distance2(), PoseFilter::kGate);
  EXPECT_EQ(robot.filter.correct({before, covariance_of(0.05, 0.05, 0.05), robot.now}), PoseRefusal::kNone);
  EXPECT_EQ(robot.filter.jumps_in_a_row(), 0U);
  EXPECT_EQ(robot.filter.accepted(), 1U);
}

TEST(PoseFilter, GatesByTheWholeDistanceAndNotAxisByAxis) {
  Driven robot({}, covariance_of(0.3, 0.4, 0.1));
  robot.drive({}, 2ms);
  const PoseCovariance sure = covariance_of(0.4, 0.3, 0.1);  // together 0.5 m, 0.5 m, 0.1414 rad
  const double x = 0.5 * std::sqrt(PoseFilter::kGate);
  PoseFilter inside = robot.filter;
  EXPECT_EQ(inside.correct({{x - 1e-6, 0, 0}, sure, robot.now}), PoseRefusal::kNone);
  PoseFilter outside = robot.filter;
  EXPECT_EQ(outside.correct({{x + 1e-6, 0, 0}, sure, robot.now}), PoseRefusal::kTooFar);
  PoseFilter corner = robot.filter;
  EXPECT_EQ(corner.correct({{0.75 * x, 0.75 * x, 0}, sure, robot.now}), PoseRefusal::kTooFar);
}

TEST(PoseFilter, RefusesWhatIsNotFiniteByName) {
  Driven robot;
  robot.drive({0.1, 0, 0}, 10ms);
  const PoseFilter before = robot.filter;
  for (int field = 0; field < 3; ++field) {
    for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
      ExternalPose pose{robot.filter.pose(), kUnsure, robot.now};
      (field == 0 ? pose.pose.x_m : field == 1 ? pose.pose.y_m : pose.pose.heading_rad) = bad;
      EXPECT_EQ(robot.filter.correct(pose), PoseRefusal::kNotFinite);
      Twist moved;
      (field == 0 ? moved.vx_mps : field == 1 ? moved.vy_mps : moved.wz_radps) = bad;
      EXPECT_EQ(robot.filter.predict(moved, robot.now + 2ms), PoseRefusal::kNotFinite);
    }
  }
  PoseCovariance broken = kUnsure;
  broken(1, 2) = kNaN;
  EXPECT_EQ(robot.filter.correct({robot.filter.pose(), broken, robot.now}), PoseRefusal::kNotFinite);
  EXPECT_EQ(robot.filter.reset({kNaN, 0, 0}, kUnsure, robot.now), PoseRefusal::kNotFinite);
  EXPECT_EQ(robot.filter.refused(PoseRefusal::kNotFinite), 14U);
  expect_same(robot.filter, before, 0.0);
  EXPECT_EQ(name_of(PoseRefusal::kNotFinite), "not finite");
}

TEST(PoseFilter, RefusesCovariancesThatAreNone) {
  Driven robot;
  robot.drive({0.1, 0, 0}, 10ms);
  PoseCovariance lopsided = kUnsure;
  lopsided(0, 1) = 0.001;
  PoseCovariance indefinite = kUnsure;
  indefinite(0, 1) = indefinite(1, 0) = 0.02;  // more than the variances 0.01 allow
  for (const PoseCovariance& none :
       {PoseCovariance(PoseCovariance::Zero()), PoseCovariance(-kUnsure), lopsided, indefinite,
        covariance_of(0.1, 0.1, 0.0), PoseCovariance(1e300 * PoseCovariance::Ones())}) {
    EXPECT_EQ(robot.filter.correct({robot.filter.pose(), none, robot.now}), PoseRefusal::kCovariance) << none;
  }
  EXPECT_EQ(robot.filter.reset({}, indefinite, robot.now), PoseRefusal::kCovariance);
  EXPECT_EQ(robot.filter.accepted(), 0U);
  EXPECT_EQ(name_of(PoseRefusal::kCovariance), "covariance not positive definite");
}

TEST(PoseFilter, StaysFiniteWithAnyCovarianceThatItTakes) {
  for (const double sigma : {1e-150, 1e-12, 1e-6, 1e6, 1e70, 1e150}) {
    Driven robot;
    robot.drive({0.5, 0, 0.5}, 1s);
    const ExternalPose seen{robot.filter.pose(), covariance_of(sigma, 0.1, sigma), robot.now - 300ms};
    (void)robot.filter.correct(seen);
    robot.drive({0.5, 0, 0.5}, 10ms);
    EXPECT_TRUE(robot.filter.covariance().allFinite()) << sigma;
    EXPECT_GE(robot.filter.covariance().diagonal().minCoeff(), 0.0) << sigma;
    EXPECT_EQ(robot.filter.covariance(), robot.filter.covariance().transpose()) << sigma;
  }
}

TEST(PoseFilter, RefusesPosesFromTheFutureAndFromTooLongAgo) {
  Driven robot;
  robot.drive({0.1, 0, 0}, 200ms);
  const auto seen_at = [&](Instant at) { return robot.filter.correct({robot.filter.pose(), kUnsure, at}); };
  EXPECT_EQ(seen_at(robot.now + 1ns), PoseRefusal::kFromFuture);
  EXPECT_EQ(seen_at(Instant::max()), PoseRefusal::kFromFuture);
  EXPECT_EQ(seen_at(kStart - 1ns), PoseRefusal::kTooOld) << "before the reset";
  EXPECT_EQ(seen_at(kStart), PoseRefusal::kNone);
  robot.drive({0.1, 0, 0}, 1s);
  EXPECT_EQ(seen_at(robot.now - 500ms), PoseRefusal::kNone);
  EXPECT_EQ(seen_at(robot.now - 500ms - 1ns), PoseRefusal::kTooOld);
  EXPECT_EQ(seen_at(Instant::min()), PoseRefusal::kTooOld);
  EXPECT_EQ(robot.filter.refused(PoseRefusal::kFromFuture), 2U);
  EXPECT_EQ(robot.filter.refused(PoseRefusal::kTooOld), 3U);
}

TEST(PoseFilter, RefusesStepsThatDoNotGoForwardInTime) {
  Driven robot;
  robot.drive({0.1, 0, 0}, 10ms);
  EXPECT_EQ(robot.filter.predict({0.1, 0, 0}, robot.now), PoseRefusal::kBackInTime);
  EXPECT_EQ(robot.filter.predict({0.1, 0, 0}, robot.now - 1ns), PoseRefusal::kBackInTime);
  EXPECT_NEAR(robot.filter.pose().x_m, 0.001, 1e-12);
}

TEST(PoseFilter, KnowsNothingBeforeItIsToldWhereItIs) {
  PoseFilter filter;
  EXPECT_EQ(filter.predict({}, kStart), PoseRefusal::kNotStarted);
  EXPECT_EQ(filter.correct({{}, kUnsure, kStart}), PoseRefusal::kNotStarted);
  EXPECT_EQ(filter.refused(PoseRefusal::kNotStarted), 2U);
}

TEST(PoseFilter, RefusesMorePosesThanItCanKeepUntilTheOldOnesArePast) {
  Driven robot;
  robot.drive({0.1, 0, 0}, 100ms);
  for (std::size_t i = 0; i < PoseFilter::kPoses; ++i) {
    ASSERT_EQ(robot.filter.correct({robot.filter.pose(), kUnsure, robot.now}), PoseRefusal::kNone);
  }
  EXPECT_EQ(robot.filter.correct({robot.filter.pose(), kUnsure, robot.now}), PoseRefusal::kTooMany);
  robot.drive({0.1, 0, 0}, 502ms);
  EXPECT_EQ(robot.filter.correct({robot.filter.pose(), kUnsure, robot.now}), PoseRefusal::kNone);
}

TEST(PoseFilter, KeepsHalfASecondAtOneKilohertzAndWhatFitsBeyond) {
  Driven fast;
  fast.drive({0.1, 0, 0}, 2s, 1ms);
  EXPECT_EQ(fast.filter.correct({fast.filter.pose(), kUnsure, fast.now - 500ms}), PoseRefusal::kNone);
  Driven faster;
  faster.drive({0.1, 0, 0}, 2s, 100us);
  EXPECT_EQ(faster.filter.correct({faster.filter.pose(), kUnsure, faster.now - 51ms}), PoseRefusal::kNone);
  EXPECT_EQ(faster.filter.correct({faster.filter.pose(), kUnsure, faster.now - 52ms}), PoseRefusal::kTooOld);
}

TEST(PoseFilter, AResetForgetsWhatWasSeenBefore) {
  Driven robot;
  robot.drive({0.5, 0, 0}, 300ms);
  ASSERT_EQ(robot.filter.correct({robot.filter.pose(), kUnsure, robot.now - 100ms}), PoseRefusal::kNone);
  ASSERT_EQ(robot.filter.reset({5, 5, 4 * pi + 1}, kUnsure, robot.now), PoseRefusal::kNone);
  EXPECT_NEAR(robot.filter.pose().heading_rad, 1.0, 1e-12);
  EXPECT_EQ(robot.filter.correct({{5, 5, 1}, kUnsure, robot.now - 2ms}), PoseRefusal::kTooOld);
  Driven fresh({5, 5, 1});
  robot.drive({0.5, 0, 0}, 300ms);
  fresh.drive({0.5, 0, 0}, 300ms);
  expect_same(robot.filter, fresh.filter, 1e-12);
}

}  // namespace
}  // namespace ivo::firmware
