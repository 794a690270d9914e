#include "firmware/loop/overrun_policy.hpp"

#include <gtest/gtest.h>

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""us;

Instant at(Duration time) { return Instant(time); }

TEST(Scheduler, KeepsItsPhaseWhenCyclesAreInTime) {
  Scheduler scheduler(at(0ms), 2ms);
  for (int i = 1; i <= 1000; ++i) {
    EXPECT_EQ(scheduler.advance(at(2ms * (i - 1)), at(2ms * (i - 1) + 500us)), 0);
    EXPECT_EQ(scheduler.deadline(), at(2ms * i));
  }
  EXPECT_EQ(scheduler.skipped(), 0U);
}

TEST(Scheduler, ACycleThatEndsOnTheNextDeadlineIsInTime) {
  Scheduler scheduler(at(0ms), 2ms);
  EXPECT_EQ(scheduler.advance(at(0ms), at(2ms)), 0);
  EXPECT_EQ(scheduler.deadline(), at(2ms));
}

TEST(Scheduler, SkipsWholePeriodsAndNeverRunsTwoCyclesInOne) {
  Scheduler scheduler(at(0ms), 2ms);
  EXPECT_EQ(scheduler.advance(at(0ms), at(7ms)), 3);  // 2, 4 and 6 ms are past
  EXPECT_EQ(scheduler.deadline(), at(8ms));
  EXPECT_EQ(scheduler.skipped(), 3U);
  EXPECT_EQ(scheduler.advance(at(8ms), at(8ms + 1us)), 0);
  EXPECT_EQ(scheduler.deadline(), at(10ms));
}

TEST(Scheduler, ADeadlineJustMissedCostsOnePeriod) {
  Scheduler scheduler(at(0ms), 2ms);
  EXPECT_EQ(scheduler.advance(at(0ms), at(2ms + Duration(1))), 1);
  EXPECT_EQ(scheduler.deadline(), at(4ms));
}

TEST(Scheduler, ACycleThatWokeLateIsNotFollowedByOneRightBehindIt) {
  Scheduler scheduler(at(0ms), 2ms);
  EXPECT_EQ(scheduler.advance(at(1900us), at(1950us)), 1);  // 2 ms would be 0.1 ms after it
  EXPECT_EQ(scheduler.deadline(), at(4ms));
}

constexpr LoopParameters kParameters{.ramp_down_at = 3, .latch_at = 5};

TEST(OverrunPolicy, HoldsOneLostPeriodAndForgetsItAfterTwentyCyclesInTime) {
  OverrunPolicy policy(kParameters, false);
  EXPECT_EQ(policy.judge(0, true), Lateness::kInTime);
  EXPECT_EQ(policy.judge(1, true), Lateness::kHeld);
  for (int i = 0; i < 19; ++i) {
    EXPECT_EQ(policy.judge(0, true), Lateness::kHeld) << i;
  }
  EXPECT_EQ(policy.judge(0, true), Lateness::kInTime);
}

TEST(OverrunPolicy, RampsDownAtKAndGoesOnOnlyWhenAllIsForgotten) {
  OverrunPolicy policy(kParameters, false);
  EXPECT_EQ(policy.judge(2, true), Lateness::kHeld);
  EXPECT_EQ(policy.judge(3, true), Lateness::kRampDown) << "the two before are remembered";
  for (int i = 0; i < 20 * 5 - 2; ++i) {
    ASSERT_EQ(policy.judge(0, true), Lateness::kRampDown) << i;
  }
  EXPECT_EQ(policy.judge(0, true), Lateness::kInTime);
}

TEST(OverrunPolicy, LatchesAtMAtOnceOrBitByBit) {
  OverrunPolicy at_once(kParameters, false);
  EXPECT_EQ(at_once.judge(5, true), Lateness::kLatched);
  OverrunPolicy bit_by_bit(kParameters, false);
  int cycles = 1;
  while (bit_by_bit.judge(1, true) != Lateness::kLatched) {
    ASSERT_LT(++cycles, 10);
  }
  EXPECT_EQ(cycles, 6) << "a twentieth of a period is forgotten in each cycle but the first";
}

TEST(OverrunPolicy, WhatWasLostWhileNothingMovesIsNotHeldAgainstTheSearch) {
  OverrunPolicy policy(kParameters, false);
  EXPECT_EQ(policy.judge(100, false), Lateness::kInTime);
  EXPECT_EQ(policy.judge(2, true), Lateness::kHeld);
}

TEST(OverrunPolicy, OnASimulatedBusLostPeriodsOnlyCount) {
  OverrunPolicy policy(kParameters, true);
  EXPECT_EQ(policy.judge(1000, true), Lateness::kHeld);
  EXPECT_EQ(policy.judge(1000, true), Lateness::kHeld);
}

TEST(OverrunPolicy, KAndMAreConfiguration) {
  OverrunPolicy policy({.ramp_down_at = 2, .latch_at = 12}, false);
  EXPECT_EQ(policy.judge(2, true), Lateness::kRampDown);
  EXPECT_EQ(policy.judge(9, true), Lateness::kRampDown);
  EXPECT_EQ(policy.judge(2, true), Lateness::kLatched);
}

}  // namespace
}  // namespace ivo::firmware
