#include <gtest/gtest.h>

#include <chrono>

#include "hal/linux/monotonic_clock.hpp"
#include "hal/sim/manual_clock.hpp"

namespace ivo::hal {
namespace {

using std::chrono::milliseconds;

TEST(ManualClock, MovesToTheDeadlineAndNeverBack) {
  ManualClock clock;
  EXPECT_EQ(clock.now(), Instant{});
  clock.sleep_until(Instant(milliseconds(2)));
  EXPECT_EQ(clock.now(), Instant(milliseconds(2)));
  clock.sleep_until(Instant(milliseconds(1)));
  EXPECT_EQ(clock.now(), Instant(milliseconds(2)));
}

TEST(MonotonicClock, SleepsNoShorterThanAskedAtAnySpeed) {
  for (const double speed : {0.5, 1.0, 3.0, 1000.0}) {
    MonotonicClock clock(speed);
    const Instant deadline = clock.now() + milliseconds(1);
    clock.sleep_until(deadline);
    EXPECT_GE(clock.now(), deadline) << "at speed " << speed;
  }
}

TEST(MonotonicClock, ReturnsAtOnceWhenTheDeadlineIsPast) {
  MonotonicClock clock;
  const Instant before = clock.now();
  clock.sleep_until(before - std::chrono::hours(1));
  EXPECT_GE(clock.now(), before);
}

}  // namespace
}  // namespace ivo::hal
