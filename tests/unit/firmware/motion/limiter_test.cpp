#include "firmware/motion/limiter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ivo::firmware {
namespace {

constexpr Duration kCycle = std::chrono::milliseconds(2);

MotionLimits limits() {
  MotionLimits limits;
  limits.max_speed_mps = 0.5;
  limits.max_turn_radps = 1.0;
  limits.max_accel_mps2 = 0.5;
  limits.max_turn_accel_radps2 = 1.5;
  limits.stop_decel_mps2 = 1.0;
  return limits;
}

double speed_of(const Twist& t) { return std::hypot(t.vx_mps, t.vy_mps); }

TEST(Limiter, ReachesTheWantedSpeedInTheTimeTheAccelerationGives) {
  Limiter limiter(limits());
  int cycles = 0;
  while (limiter.limit({0.4, 0, 0}, kCycle).vx_mps < 0.4) {
    ASSERT_LT(++cycles, 1000);
  }
  EXPECT_NEAR(cycles, 400, 2);
}

TEST(Limiter, KeepsTheDirectionWhileItSpeedsUp) {
  Limiter limiter(limits());
  for (int i = 0; i < 100; ++i) {
    const Twist t = limiter.limit({0.4, -0.3, 0}, kCycle);
    ASSERT_NEAR(t.vy_mps / t.vx_mps, -0.75, 1e-9);
  }
}

TEST(Limiter, KeepsTheDirectionWhenTheSpeedIsCut) {
  Limiter limiter(limits());
  const Twist t = limiter.limit({8.0, 6.0, 9.0}, std::chrono::seconds(10));
  EXPECT_NEAR(t.vx_mps, 0.4, 1e-12);
  EXPECT_NEAR(t.vy_mps, 0.3, 1e-12);
  EXPECT_EQ(t.wz_radps, 1.0);
}

TEST(Limiter, NeverExceedsALimitWhateverIsWanted) {
  Limiter limiter(limits());
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  Twist before;
  Twist wanted;
  for (int i = 0; i < 20'000; ++i) {
    if (i % 50 == 0) {
      wanted = {any(random), any(random), any(random)};
    }
    const Twist t = limiter.limit(wanted, kCycle);
    ASSERT_LE(speed_of(t), 0.5 + 1e-12);
    ASSERT_LE(std::abs(t.wz_radps), 1.0);
    ASSERT_LE(std::hypot(t.vx_mps - before.vx_mps, t.vy_mps - before.vy_mps), 0.5 * 0.002 + 1e-12);
    ASSERT_LE(std::abs(t.wz_radps - before.wz_radps), 1.5 * 0.002 + 1e-12);
    before = t;
  }
}

TEST(Limiter, RampsDownStraightToExactRest) {
  Limiter limiter(limits());
  limiter.reset({0.3, 0.4, -0.6});
  int cycles = 0;
  while (speed_of(limiter.current()) > 0) {
    const Twist t = limiter.ramp_down(kCycle);
    ASSERT_NEAR(t.vy_mps * 3.0, t.vx_mps * 4.0, 1e-9);
    ASSERT_LT(++cycles, 1000);
  }
  EXPECT_NEAR(cycles, 250, 1);
  EXPECT_EQ(limiter.current().vx_mps, 0.0);
  EXPECT_EQ(limiter.current().vy_mps, 0.0);
  EXPECT_EQ(limiter.current().wz_radps, 0.0) << "0.6 rad/s at 1.5 rad/s^2 is gone sooner than the translation";
}

TEST(Limiter, StopsFasterThanItSlowsDown) {
  Limiter planned(limits());
  Limiter stopped(limits());
  planned.reset({0.5, 0, 0});
  stopped.reset({0.5, 0, 0});
  EXPECT_NEAR(planned.limit({}, kCycle).vx_mps, 0.499, 1e-12);
  EXPECT_NEAR(stopped.ramp_down(kCycle).vx_mps, 0.498, 1e-12);
}

TEST(Limiter, TakesWhatIsNotANumberAsAWishToStop) {
  Limiter limiter(limits());
  limiter.reset({0.3, 0.0, 0.5});
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(limiter.limit({nan, inf, -inf}, kCycle).vx_mps, 0.299, 1e-12);
  EXPECT_NEAR(limiter.current().wz_radps, 0.497, 1e-12);
}

TEST(Limiter, StandsStillWhenTimeDoes) {
  Limiter limiter(limits());
  limiter.reset({0.1, 0.0, 0.1});
  EXPECT_EQ(limiter.limit({0.5, 0, 1}, Duration(0)).vx_mps, 0.1);
  EXPECT_EQ(limiter.limit({0.5, 0, 1}, -kCycle).vx_mps, 0.1);
  EXPECT_EQ(limiter.ramp_down(-kCycle).wz_radps, 0.1);
}

}  // namespace
}  // namespace ivo::firmware
