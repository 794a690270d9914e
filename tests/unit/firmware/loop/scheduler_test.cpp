#include "firmware/loop/scheduler.hpp"

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

}  // namespace
}  // namespace ivo::firmware
