#include "firmware/safety/wheel_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <tuple>

#include "drivers/drive_fault_text.hpp"
#include "firmware/motion/limiter.hpp"
#include "tests/unit/firmware/safety/simulated_wheels.hpp"

namespace ivo::firmware {
namespace {

using drivers::DriveFault;
using drivers::DriveFaultReason;
using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

/// Counts a turn of the wheel: 0.02, 0.15, 1.5 and 31 mm at the rim of a wheel of 0.1 m.
constexpr std::array<double, 4> kCounts{31'416.0, 4'096.0, 419.0, 20.0};

Robot robot_with(WheelGeometry geometry, Duration cycle, double counts = 4096.0) {
  Robot robot;
  robot.base.geometry = geometry;
  robot.cycle = cycle;
  for (DriveParameters& drive : robot.drives) {
    drive.counts_per_turn = counts;
  }
  return robot;
}

/// A robot that drives at a twist, limited as the loop limits it, watched by the monitor.
class Watched {
 public:
  explicit Watched(const Robot& robot, std::uint64_t seed = 1)
      : robot_(robot), kinematics_(robot.base), limiter_(robot.limits), monitor(robot), wheels(robot, seed) {}

  /// One cycle towards `wanted`; what the monitor said.
  std::optional<DriveFault> cycle(const Twist& wanted, bool enabled = true) {
    if (!enabled) {
      limiter_.reset();
      told_ = {};
    }
    wheels.step(told_);
    const std::optional<DriveFault> verdict =
        monitor.update({.told_radps = told_, .angle_rad = wheels.angle_rad(), .enabled = enabled}, now);
    if (enabled) {
      const double scale = kinematics_.saturation(kinematics_.wheel_speeds(wanted));
      told_ = kinematics_.wheel_speeds(
          limiter_.limit({wanted.vx_mps * scale, wanted.vy_mps * scale, wanted.wz_radps * scale}, robot_.cycle));
    }
    now += robot_.cycle;
    return verdict;
  }
  /// The command stops at once, as when the gate refuses it.
  void drop_command() {
    limiter_.reset();
    told_ = {};
  }
  std::optional<DriveFault> drive(const Twist& wanted, Duration time) {
    for (const Instant end = now + time; now < end;) {
      if (const std::optional<DriveFault> verdict = cycle(wanted)) {
        return verdict;
      }
    }
    return std::nullopt;
  }

 private:
  Robot robot_;
  Kinematics kinematics_;
  Limiter limiter_;
  WheelValues told_{};

 public:
  WheelMonitor monitor;
  test::SimulatedWheels wheels;
  Instant now{5s};
};

class WheelMonitorOf : public testing::TestWithParam<std::tuple<WheelGeometry, Duration>> {
 protected:
  static Robot robot(double counts = 4096.0) {
    return robot_with(std::get<0>(GetParam()), std::get<1>(GetParam()), counts);
  }
};
INSTANTIATE_TEST_SUITE_P(GeometriesAndRates, WheelMonitorOf,
                         testing::Combine(testing::Values(WheelGeometry::kMecanum, WheelGeometry::kOmniX),
                                          testing::Values(Duration(2ms), Duration(1ms))));

TEST_P(WheelMonitorOf, AWheelThatIsBlockedIsNamed) {
  for (const double counts : kCounts) {
    for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
      Watched base(robot(counts));
      ASSERT_FALSE(base.drive({0.4, 0, 0}, 3s));
      base.wheels.drives[wheel].follows = 0.0;
      base.wheels.drives[wheel].ramp_mps2 = 100.0;
      base.wheels.drives[wheel].lag_s = 0.001;
      const Instant blocked = base.now;
      const std::optional<DriveFault> verdict = base.drive({0.4, 0, 0}, 2s);
      ASSERT_TRUE(verdict) << counts;
      EXPECT_EQ(verdict->wheel, static_cast<Wheel>(wheel)) << counts;
      EXPECT_EQ(verdict->node_id, wheel + 1);
      EXPECT_TRUE(verdict->reason == DriveFaultReason::kEncoderStuck ||
                  verdict->reason == DriveFaultReason::kWheelNotFollowing)
          << describe(*verdict);
      EXPECT_LE(seconds(base.now - blocked), std::max(0.3, 4.0 * 0.6284 / counts / 0.4 + 0.15)) << counts;
    }
  }
}

TEST_P(WheelMonitorOf, AnEncoderThatStaysFromTheStartIsNamedEvenAtACrawl) {
  for (const double counts : kCounts) {
    for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
      Watched base(robot(counts));
      base.wheels.drives[wheel].encoder_works = false;
      const std::optional<DriveFault> verdict = base.drive({0.05, 0, 0}, 5s);
      ASSERT_TRUE(verdict) << counts;
      EXPECT_EQ(verdict->reason, DriveFaultReason::kEncoderStuck) << describe(*verdict);
      EXPECT_EQ(verdict->wheel, static_cast<Wheel>(wheel));
      const double way_m = std::max(0.030, 4.0 * 0.6284 / counts);
      EXPECT_LE(seconds(base.now - Instant(5s)), 0.5 + way_m / 0.035) << counts;
    }
  }
}

TEST_P(WheelMonitorOf, AStuckEncoderThatFlickersByOneCountIsStuckAllTheSame) {
  const Robot parameters = robot(419.0);
  WheelMonitor monitor(parameters);
  const Kinematics kinematics(parameters.base);
  const WheelValues told = kinematics.wheel_speeds({0.2, 0, 0});
  WheelValues angle{};
  std::optional<DriveFault> verdict;
  Instant now{1s};
  for (int i = 0; i < 2000 && !verdict; ++i, now += parameters.cycle) {
    for (std::size_t w = 1; w < kWheels; ++w) {
      angle[w] += told[w] * seconds(parameters.cycle);
    }
    angle[0] = i % 2 * 2 * 3.14159265 / 419.0;
    verdict = monitor.update({.told_radps = told, .angle_rad = angle, .enabled = true}, now);
  }
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->reason, DriveFaultReason::kEncoderStuck);
  EXPECT_EQ(verdict->wheel, Wheel::kFrontLeft);
}

TEST_P(WheelMonitorOf, AWheelThatTurnsAtHalfItsSpeedIsNamed) {
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    Watched base(robot());
    ASSERT_FALSE(base.drive({0, 0.5, 0}, 3s));
    base.wheels.drives[wheel].follows = 0.4;
    const Instant slow = base.now;
    const std::optional<DriveFault> verdict = base.drive({0, 0.5, 0}, 2s);
    ASSERT_TRUE(verdict);
    EXPECT_EQ(verdict->reason, DriveFaultReason::kWheelNotFollowing) << describe(*verdict);
    EXPECT_EQ(verdict->wheel, static_cast<Wheel>(wheel));
    EXPECT_GT(verdict->code, 150U);
    EXPECT_LT(verdict->code, 500U);
    EXPECT_LE(base.now - slow, 600ms);
  }
}

TEST_P(WheelMonitorOf, AWheelThatRunsAwayAtRestIsNamed) {
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    for (const double sign : {-1.0, 1.0}) {
      Watched base(robot());
      ASSERT_FALSE(base.drive({}, 1s));
      base.wheels.drives[wheel].driven_mps = 0.2 * sign;
      const Instant away = base.now;
      const std::optional<DriveFault> verdict = base.drive({}, 1s);
      ASSERT_TRUE(verdict);
      EXPECT_EQ(verdict->reason, DriveFaultReason::kWheelNotFollowing) << describe(*verdict);
      EXPECT_EQ(verdict->wheel, static_cast<Wheel>(wheel));
      EXPECT_LE(base.now - away, 300ms);
    }
  }
}

TEST_P(WheelMonitorOf, AWheelThatTurnsTheWrongWayIsNamedWithinAHand) {
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    Watched base(robot());
    base.wheels.drives[wheel].follows = -1.0;
    const std::optional<DriveFault> verdict = base.drive({0.4, 0, 0}, 3s);
    ASSERT_TRUE(verdict);
    EXPECT_EQ(verdict->reason, DriveFaultReason::kWheelNotFollowing) << describe(*verdict);
    EXPECT_EQ(verdict->wheel, static_cast<Wheel>(wheel));
    EXPECT_LE(base.now - Instant(5s), 800ms);
  }
}

TEST_P(WheelMonitorOf, ManyWheelsThatAreOffALittleAreSlip) {
  Watched base(robot());
  ASSERT_FALSE(base.drive({0.3, 0, 0}, 3s));
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    base.wheels.drives[wheel].driven_mps = wheel < 2 ? 0.07 : -0.07;
  }
  const Instant began = base.now;
  const std::optional<DriveFault> verdict = base.drive({0.3, 0, 0}, 2s);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->reason, DriveFaultReason::kWheelSlip) << describe(*verdict);
  EXPECT_EQ(verdict->node_id, 0) << "of no drive";
  EXPECT_NEAR(verdict->code, 140.0, 20.0);
  EXPECT_LE(base.now - began, 400ms);
  EXPECT_NE(describe(*verdict).find("wheels slip: 1"), std::string::npos) << describe(*verdict);
}

TEST_P(WheelMonitorOf, JudgesNothingWhileTheDrivesAreOff) {
  Watched base(robot());
  for (auto& drive : base.wheels.drives) {
    drive.driven_mps = 0.8;  // pushed by hand
  }
  for (int i = 0; i < 2000; ++i) {
    ASSERT_FALSE(base.cycle({}, false));
  }
}

TEST_P(WheelMonitorOf, ForgetsAFaultWhenTheDrivesGoOff) {
  Watched base(robot());
  base.wheels.drives[2].encoder_works = false;
  ASSERT_TRUE(base.drive({0.3, 0, 0}, 3s));
  EXPECT_TRUE(base.cycle({0.3, 0, 0})) << "the verdict stands";
  EXPECT_FALSE(base.cycle({}, false));
  base.wheels.drives[2].encoder_works = true;
  base.wheels.drives[2].ramp_mps2 = 50.0;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(base.cycle({}, false));
  }
  EXPECT_FALSE(base.drive({0.3, 0, 0}, 3s));
}

TEST_P(WheelMonitorOf, TakesAnAngleThatIsNotANumberForAWheelThatDoesNotFollow) {
  WheelMonitor monitor(robot());
  WheelValues angle{};
  angle[3] = std::nan("");
  std::optional<DriveFault> verdict;
  for (Instant now{1s}; now < Instant(2s) && !verdict; now += robot().cycle) {
    verdict = monitor.update({.told_radps = {}, .angle_rad = angle, .enabled = true}, now);
  }
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->wheel, Wheel::kRearRight);
}

TEST_P(WheelMonitorOf, ALateCycleIsNoFaultOfTheWheels) {
  Watched base(robot());
  for (int i = 0; i < 40; ++i) {
    ASSERT_FALSE(base.drive({0.4, 0, 0}, 97ms));
    base.now += 60ms;  // nothing was sent or heard
  }
}

/// Seeded motions of all kinds with drives of all kinds: no stop, ever.
TEST_P(WheelMonitorOf, NeverStopsWheelsThatDoTheirWork) {
  for (const double counts : kCounts) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", counts " + std::to_string(counts));
      std::mt19937_64 random(seed);
      std::uniform_real_distribution<double> share(-1.0, 1.0);
      Watched base(robot(counts), seed);
      base.wheels.draw_drives();
      for (int leg = 0; leg < 40; ++leg) {
        const Twist wanted = leg % 7 == 3 ? Twist{} : Twist{share(random), share(random), share(random)};
        const auto time = Duration(static_cast<Duration::rep>(1e9 * (0.05 + 0.9 * std::abs(share(random)))));
        const std::optional<DriveFault> verdict = base.drive(wanted, time);
        ASSERT_FALSE(verdict) << "leg " << leg << ": " << describe(*verdict);
        if (leg % 5 == 4) {
          base.drop_command();
        }
      }
    }
  }
}

}  // namespace
}  // namespace ivo::firmware
