#include "firmware/loop/planner_pace.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "config/rates.hpp"

namespace ivo::firmware {
namespace {

using planner::SliceKind;
using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""us;

constexpr double kSlow_ns = 30.0;  // what it begins with
constexpr double kOver = 1.2;      // a slice may go a fifth over its budget

TEST(PlannerPace, SlicesFitIntoTheTimeThatIsLeftWithAMargin) {
  PlannerPace pace;
  for (int i = 0; i < 1000; ++i) {
    pace.ran(SliceKind::kChanges, 100'000, 8ms);  // 80 ns a unit
  }
  EXPECT_NEAR(pace.unit_cost_ns(), 80.0, 0.1);
  const int units = pace.units_within(1ms);
  EXPECT_LT(units * 80.0 * kOver, 1e6);
  EXPECT_GT(units * 80.0, 0.7e6);
}

TEST(PlannerPace, ADearSliceCountsAtOnceAndCheapOnesLittleByLittle) {
  PlannerPace pace;
  pace.ran(SliceKind::kAnts, 10'000, 1ms);
  EXPECT_DOUBLE_EQ(pace.unit_cost_ns(), 100.0);
  pace.ran(SliceKind::kAnts, 10'000, 400us);
  EXPECT_GT(pace.unit_cost_ns(), 95.0);
  for (int i = 0; i < 500; ++i) {
    pace.ran(SliceKind::kAnts, 10'000, 400us);
  }
  EXPECT_NEAR(pace.unit_cost_ns(), 40.0, 0.2);
}

TEST(PlannerPace, ACheapKindDoesNotMakeTheNextDearOneTooLong) {
  PlannerPace pace;
  pace.ran(SliceKind::kPathScore, 10'000, 800us);  // 80 ns a unit
  for (int i = 0; i < 100; ++i) {
    pace.ran(SliceKind::kAnts, 10'000, 20us);
  }
  EXPECT_LT(pace.units_within(1ms) * 80.0 * kOver, 1e6);
}

TEST(PlannerPace, AKindThatNeverComesAgainIsForgottenInTheEnd) {
  PlannerPace pace;
  pace.ran(SliceKind::kDrafts, 10'000, 4ms);
  for (int i = 0; i < 10'000; ++i) {
    pace.ran(SliceKind::kChanges, 10'000, 20us);
  }
  EXPECT_NEAR(pace.unit_cost_ns(), kSlow_ns, 0.1);
}

TEST(PlannerPace, DoesNothingWhereNoSliceFits) {
  const PlannerPace pace;
  EXPECT_EQ(pace.units_within(Duration(0)), 0);
  EXPECT_EQ(pace.units_within(Duration(-1ms)), 0);
  EXPECT_EQ(pace.units_within(5us), 0);
}

TEST(PlannerPace, AProcessorThatWasTakenAwayDoesNotEndThinkingForGoodNotEvenAt1kHz) {
  PlannerPace pace;
  pace.ran(SliceKind::kScore, 1'000, Duration(std::chrono::seconds(2)));
  EXPECT_GT(pace.units_within(Duration(rates::kShortestCycle) * rates::kThinkUntilPercent / 100), 0);
}

}  // namespace
}  // namespace ivo::firmware
