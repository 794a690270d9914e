#include "hal/linux/arrival_stamps.hpp"

#include <gtest/gtest.h>

namespace ivo::hal {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr Duration kWall = std::chrono::seconds(1'700'000'000);
constexpr Instant at_ms(int ms) { return Instant(milliseconds(ms)); }

TEST(ArrivalStamps, SubtractTheAgeFromNow) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, false);
  stamps.begin(at_ms(12), kWall + milliseconds(2), false);
  EXPECT_EQ(stamps.at(kWall + microseconds(1500)), at_ms(12) - microseconds(500));
  EXPECT_EQ(stamps.at(kWall + microseconds(300)), at_ms(10) + microseconds(300));
  EXPECT_EQ(stamps.clamped(), 0U);
}

TEST(ArrivalStamps, AtTheFirstCallEveryFrameArrivesNow) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, true);
  EXPECT_EQ(stamps.at(kWall - milliseconds(7)), at_ms(10));
  EXPECT_EQ(stamps.at(kWall), at_ms(10));
}

TEST(ArrivalStamps, WithoutAStampItIsNow) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, false);
  stamps.begin(at_ms(12), kWall + milliseconds(2), false);
  EXPECT_EQ(stamps.at(Duration::zero()), at_ms(12));
  EXPECT_EQ(stamps.clamped(), 0U);
}

TEST(ArrivalStamps, AClockThatIsSetForwardMovesNothingBeforeTheLastCall) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, false);
  stamps.begin(at_ms(12), kWall + hours(1), false);  // set after the frame had come
  EXPECT_EQ(stamps.at(kWall + milliseconds(1)), at_ms(10));
  EXPECT_EQ(stamps.clamped(), 1U);
}

TEST(ArrivalStamps, AClockThatIsSetBackMovesNothingAfterNow) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, false);
  stamps.begin(at_ms(12), kWall - hours(1), false);
  EXPECT_EQ(stamps.at(kWall + milliseconds(1)), at_ms(12));
  EXPECT_EQ(stamps.clamped(), 1U);
}

TEST(ArrivalStamps, AfterAStepStampsAreRightAgain) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, false);
  stamps.begin(at_ms(12), kWall - hours(1), false);
  stamps.begin(at_ms(14), kWall - hours(1) + milliseconds(2), false);
  EXPECT_EQ(stamps.at(kWall - hours(1) + milliseconds(1)), at_ms(13));
  EXPECT_EQ(stamps.clamped(), 0U);
}

TEST(ArrivalStamps, AFrameThatArrivesWhileWeReadIsNowAndNoStep) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, false);
  stamps.begin(at_ms(12), kWall + milliseconds(2), false);
  EXPECT_EQ(stamps.at(kWall + milliseconds(2) + microseconds(40)), at_ms(12));
  EXPECT_EQ(stamps.clamped(), 0U);
}

TEST(ArrivalStamps, FramesLeftFromBeforeAreNoStepEither) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, false);
  stamps.begin(at_ms(20), kWall + milliseconds(10), true);
  EXPECT_EQ(stamps.at(kWall - milliseconds(50)), at_ms(10));
  EXPECT_EQ(stamps.clamped(), 0U);
}

TEST(ArrivalStamps, HoldForAClockOfTheCallersThatStandsStill) {
  ArrivalStamps stamps;
  stamps.begin(at_ms(10), kWall, false);
  stamps.begin(at_ms(10), kWall + milliseconds(500), false);
  EXPECT_EQ(stamps.at(kWall + milliseconds(200)), at_ms(10));
}

}  // namespace
}  // namespace ivo::hal
