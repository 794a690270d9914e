#include "hal/api/transmit_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "config/rates.hpp"

namespace ivo::hal {
namespace {

using std::chrono::milliseconds;

constexpr Instant after_ms(int ms) { return Instant(milliseconds(ms)); }

CanFrame frame(std::uint16_t id, std::uint8_t value) { return {.id = id, .size = 2, .data = {value, 0}}; }
CanFrame nmt(std::uint8_t command, std::uint8_t node) { return {.id = 0, .size = 2, .data = {command, node}}; }

IdSet all_ids() { return IdSet().set(); }

class Table : public testing::Test {
 protected:
  /// Offers `given` and hands over `room` at most; returns what went.
  std::vector<CanFrame> send(const std::vector<CanFrame>& given, Instant now, std::size_t room = 1000) {
    const auto offered = table_.offer(given, now);
    const std::size_t count = std::min(offered.size(), room);
    std::vector<CanFrame> went(offered.begin(), offered.begin() + static_cast<std::ptrdiff_t>(count));
    taken_ = table_.handed_over(count, now);
    return went;
  }
  void echo(const std::vector<CanFrame>& frames, Instant now) {
    for (const CanFrame& one : frames) {
      table_.echo(one, now);
    }
  }

  TransmitTable table_{all_ids()};
  std::size_t taken_ = 0;
};

using TransmitTableTest = Table;

TEST_F(TransmitTableTest, HandsOverInOrderAndSaysHowManyOfTheGivenWent) {
  const std::vector<CanFrame> given{frame(0x80, 1), frame(0x201, 2), frame(0x203, 3), frame(0x202, 4)};
  EXPECT_EQ(send(given, after_ms(0)), given);
  EXPECT_EQ(taken_, 4U);
  EXPECT_EQ(table_.in_flight(), 4U);
  EXPECT_EQ(table_.counters().handed_over, 4U);
  EXPECT_EQ(table_.counters().confirmed, 0U);
}

TEST_F(TransmitTableTest, AFrameWaitsWhileOneOfItsIdIsInFlight) {
  send({frame(0x201, 1)}, after_ms(0));
  EXPECT_TRUE(send({frame(0x201, 2)}, after_ms(2)).empty());
  EXPECT_EQ(taken_, 0U);
  echo({frame(0x201, 1)}, after_ms(3));
  EXPECT_EQ(send({}, after_ms(4)), (std::vector{frame(0x201, 2)}));
  EXPECT_EQ(taken_, 0U) << "it was not given now";
}

TEST_F(TransmitTableTest, TheNewestValueWins) {
  send({frame(0x201, 1)}, after_ms(0));
  send({frame(0x201, 2)}, after_ms(2));
  send({frame(0x201, 3)}, after_ms(4));
  echo({frame(0x201, 1)}, after_ms(5));
  EXPECT_EQ(send({frame(0x201, 4)}, after_ms(6)), (std::vector{frame(0x201, 4)}));
  EXPECT_EQ(table_.counters().replaced, 2U);
  EXPECT_EQ(table_.waiting(), 0U);
}

TEST_F(TransmitTableTest, OfOneIdTwiceInACallTheSecondWaits) {
  EXPECT_EQ(send({frame(0x201, 1), frame(0x201, 2)}, after_ms(0)), (std::vector{frame(0x201, 1)}));
  EXPECT_EQ(taken_, 1U);
  echo({frame(0x201, 1)}, after_ms(1));
  EXPECT_EQ(send({}, after_ms(2)), (std::vector{frame(0x201, 2)}));
}

TEST_F(TransmitTableTest, OfOneIdTwiceInACallThatIsRefusedTheNewerStays) {
  send({frame(0x201, 1), frame(0x201, 2)}, after_ms(0), 0);
  EXPECT_EQ(send({}, after_ms(2)), (std::vector{frame(0x201, 2)}));
  EXPECT_EQ(table_.counters().replaced, 1U);
}

TEST_F(TransmitTableTest, NewFramesGoBeforeLeftOversAndBothKeepTheirOrder) {
  send({frame(0x203, 1), frame(0x201, 1), frame(0x202, 1)}, after_ms(0), 1);
  EXPECT_EQ(taken_, 1U);
  EXPECT_EQ(send({frame(0x602, 2), frame(0x80, 2)}, after_ms(2)),
            (std::vector{frame(0x602, 2), frame(0x80, 2), frame(0x201, 1), frame(0x202, 1)}));
  EXPECT_EQ(taken_, 2U);
}

TEST_F(TransmitTableTest, NeverSendsWhatIsOlderThanTheLimit) {
  const Instant limit = after_ms(0) + rates::kTransmitAge;
  send({frame(0x201, 1), frame(0x202, 1)}, after_ms(0), 0);
  EXPECT_EQ(send({}, limit, 1), (std::vector{frame(0x201, 1)})) << "as old as the limit is not older";
  EXPECT_TRUE(send({}, limit + Duration(1)).empty());
  EXPECT_EQ(table_.counters().dropped, 1U);
  EXPECT_EQ(table_.waiting(), 0U);
}

TEST_F(TransmitTableTest, BehindAFrameThatDoesNotLeaveOldValuesDieToo) {
  send({frame(0x201, 1)}, after_ms(0));
  send({frame(0x201, 2)}, after_ms(2));
  send({}, after_ms(7));
  echo({frame(0x201, 1)}, after_ms(8));
  EXPECT_TRUE(send({}, after_ms(8)).empty());
  EXPECT_EQ(table_.counters().dropped, 1U);
}

TEST_F(TransmitTableTest, KeepsNmtCommandsOfDifferentNodesApart) {
  send({nmt(0x82, 1), nmt(0x82, 2)}, after_ms(0), 0);
  send({nmt(0x01, 2)}, after_ms(1), 0);
  EXPECT_EQ(send({}, after_ms(2)), (std::vector{nmt(0x01, 2), nmt(0x82, 1)})) << "of left-overs the newer first";
  EXPECT_EQ(table_.counters().replaced, 1U);
  echo({nmt(0x01, 2)}, after_ms(3));
  EXPECT_EQ(send({nmt(0x80, 1), nmt(0x80, 2)}, after_ms(4)), (std::vector{nmt(0x80, 2)})) << "node 1's is in flight";
}

TEST_F(TransmitTableTest, KnowsWhatWentLast) {
  send({frame(0x80, 1), frame(0x201, 1)}, after_ms(0), 1);
  EXPECT_TRUE(table_.just_handed_over(0x80));
  EXPECT_FALSE(table_.just_handed_over(0x201));
  send({}, after_ms(2));
  EXPECT_TRUE(table_.just_handed_over(0x201)) << "left over, and gone now";
  EXPECT_FALSE(table_.just_handed_over(0x80));
}

TEST_F(TransmitTableTest, IsUnconfirmedWhenNothingLeavesForTheTimeOutAndUntilSomethingDoes) {
  send({frame(0x80, 1), frame(0x201, 1)}, after_ms(0));
  table_.settle(after_ms(0) + rates::kTransmitTimeout - Duration(1));
  EXPECT_FALSE(table_.unconfirmed());
  table_.settle(after_ms(0) + rates::kTransmitTimeout);
  EXPECT_TRUE(table_.unconfirmed());
  echo({frame(0x80, 1)}, after_ms(30));
  EXPECT_FALSE(table_.unconfirmed());
  table_.settle(after_ms(30) + rates::kTransmitTimeout - Duration(1));
  EXPECT_FALSE(table_.unconfirmed()) << "0x201 is in flight, but something left";
  table_.settle(after_ms(30) + rates::kTransmitTimeout);
  EXPECT_TRUE(table_.unconfirmed());
}

TEST_F(TransmitTableTest, IsNotUnconfirmedWithNothingInFlight) {
  send({frame(0x80, 1)}, after_ms(0));
  echo({frame(0x80, 1)}, after_ms(1));
  table_.settle(after_ms(10'000));
  EXPECT_FALSE(table_.unconfirmed());
}

TEST_F(TransmitTableTest, WhileNothingLeavesOneFrameASecondIsLetThroughTheLeastUrgent) {
  send({frame(0x77F, 1), frame(0x201, 1), nmt(1, 1)}, after_ms(0));
  int sent = 0;
  for (int ms = 20; ms < 3020; ms += 2) {
    table_.settle(after_ms(ms));
    for (const CanFrame& went : send({frame(0x201, 2), frame(0x77F, 2), nmt(1, 1)}, after_ms(ms))) {
      EXPECT_EQ(went.id, 0x77F);
      ++sent;
    }
  }
  EXPECT_EQ(sent, 2);
  EXPECT_TRUE(table_.unconfirmed());
}

TEST_F(TransmitTableTest, AnEchoThatIsLostDoesNotBlockItsIdForEver) {
  send({frame(0x201, 1), frame(0x204, 1)}, after_ms(0));
  echo({frame(0x204, 1)}, after_ms(1));
  EXPECT_EQ(send({frame(0x201, 2), frame(0x204, 2)}, after_ms(4)), (std::vector{frame(0x204, 2)}));
  echo({frame(0x204, 2)}, after_ms(5));
  EXPECT_EQ(table_.counters().echo_lost, 1U) << "0x204 is less urgent, was given later, and has left";
  EXPECT_EQ(send({}, after_ms(6)), (std::vector{frame(0x201, 2)}));
}

TEST_F(TransmitTableTest, AMoreUrgentFrameMayOvertakeForAsLongAsTheTimeOut) {
  send({frame(0x204, 1)}, after_ms(0));
  for (int ms = 2; ms < 20; ms += 2) {
    send({frame(0x80, 0)}, after_ms(ms));
    echo({frame(0x80, 0)}, after_ms(ms + 1));
  }
  EXPECT_EQ(table_.in_flight(), 1U);
  send({frame(0x80, 0)}, after_ms(20));
  echo({frame(0x80, 0)}, after_ms(21));
  EXPECT_EQ(table_.in_flight(), 0U);
  EXPECT_EQ(table_.counters().echo_lost, 1U);
}

TEST_F(TransmitTableTest, ALateEchoOfAFrameThatWasGivenUpHarmsNothing) {
  send({frame(0x201, 1), frame(0x204, 1)}, after_ms(0));
  echo({frame(0x204, 1)}, after_ms(1));
  send({frame(0x204, 2)}, after_ms(4));
  echo({frame(0x204, 2), frame(0x201, 1)}, after_ms(5));
  EXPECT_EQ(table_.in_flight(), 0U);
  EXPECT_EQ(table_.counters().confirmed, 3U);
}

TEST_F(TransmitTableTest, ForgetsWhatWaitsAndWhatIsInFlight) {
  send({frame(0x201, 1), frame(0x202, 1)}, after_ms(0), 1);
  table_.settle(after_ms(20));
  ASSERT_TRUE(table_.unconfirmed());
  table_.forget();
  EXPECT_FALSE(table_.unconfirmed());
  EXPECT_FALSE(table_.just_handed_over(0x201));
  EXPECT_EQ(table_.counters().dropped, 1U);
  EXPECT_EQ(send({frame(0x201, 2)}, after_ms(21)), (std::vector{frame(0x201, 2)})) << "what waited is gone";
}

TEST_F(TransmitTableTest, DropsAndCountsFramesForWhichThereIsNoSlot) {
  std::vector<CanFrame> many;
  for (std::uint16_t id = 1; id <= TransmitTable::kSlots + 3; ++id) {
    many.push_back(frame(id, 0));
  }
  EXPECT_EQ(send(many, after_ms(0)).size(), TransmitTable::kSlots);
  EXPECT_EQ(table_.counters().dropped, 3U);
  echo({frame(1, 0)}, after_ms(1));
  EXPECT_EQ(send({frame(0x700, 0)}, after_ms(2)).size(), 1U) << "a slot that is free again";
}

TEST(TransmitTableWithoutEcho, CountsAsConfirmedWhatWasHandedOver) {
  TransmitTable table;
  const std::vector<CanFrame> twice{frame(0x581, 1), frame(0x581, 2)};
  ASSERT_EQ(table.offer(twice, after_ms(0)).size(), 2U) << "nothing is ever in flight";
  EXPECT_EQ(table.handed_over(2, after_ms(0)), 2U);
  EXPECT_EQ(table.counters().confirmed, 2U);
  table.settle(after_ms(10'000));
  EXPECT_FALSE(table.unconfirmed());
}

TEST(TransmitTableWithoutEcho, StillKeepsTheNewestOfWhatWasRefused) {
  TransmitTable table;
  const std::vector<CanFrame> twice{frame(0x581, 1), frame(0x581, 2)};
  ASSERT_EQ(table.offer(twice, after_ms(0)).size(), 2U);
  EXPECT_EQ(table.handed_over(0, after_ms(0)), 0U);
  EXPECT_EQ(table.counters().replaced, 1U);
  const auto later = table.offer({}, after_ms(2));
  ASSERT_EQ(later.size(), 1U);
  EXPECT_EQ(later[0], frame(0x581, 2));
}

TEST(TransmitTableWithoutEcho, TakesMoreFramesThanItHasSlotsWhenTheBusDoes) {
  TransmitTable table;
  std::vector<CanFrame> many;
  for (std::uint16_t id = 1; id <= 200; ++id) {
    many.push_back(frame(id, 0));
  }
  EXPECT_EQ(table.offer(many, after_ms(0)).size(), 200U);
  EXPECT_EQ(table.handed_over(200, after_ms(0)), 200U);
  EXPECT_EQ(table.counters().dropped, 0U);
}

TEST(TransmitTableWithOneEcho, WaitsForThatIdAlone) {
  IdSet one;
  one.set(0x201);
  TransmitTable table(one);
  const std::vector<CanFrame> frames{frame(0x201, 1), frame(0x202, 1)};
  (void)table.offer(frames, after_ms(0));
  (void)table.handed_over(2, after_ms(0));
  EXPECT_EQ(table.in_flight(), 1U);
  EXPECT_EQ(table.counters().confirmed, 1U);
}

}  // namespace
}  // namespace ivo::hal
