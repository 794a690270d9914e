#include <gtest/gtest.h>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/emcy.hpp"
#include "drivers/canopen/heartbeat.hpp"
#include "drivers/canopen/little_endian.hpp"
#include "drivers/canopen/nmt.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/canopen/sync.hpp"

namespace ivo::drivers {
namespace {

using std::chrono::milliseconds;

TEST(LittleEndian, LoadsAndStoresLeastSignificantByteFirst) {
  std::array<std::uint8_t, 4> bytes{};
  store(std::span(bytes), std::uint32_t{0x11223344});
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 4>{0x44, 0x33, 0x22, 0x11}));
  EXPECT_EQ(load<std::uint32_t>(bytes), 0x11223344U);
  EXPECT_EQ(load<std::uint16_t>(bytes), 0x3344U);
  EXPECT_EQ(load<std::uint8_t>(bytes), 0x44U);
}

TEST(LittleEndian, TrapsOnBytesThatAreNotThere) {
  const std::array<std::uint8_t, 3> bytes{};
  EXPECT_DEATH((void)load<std::uint32_t>(bytes), "");
}

TEST(CobId, FollowsThePredefinedConnectionSet) {
  EXPECT_EQ(cob_id::emcy(3), 0x083);
  EXPECT_EQ(cob_id::tpdo1(3), 0x183);
  EXPECT_EQ(cob_id::rpdo1(3), 0x203);
  EXPECT_EQ(cob_id::sdo_answer(3), 0x583);
  EXPECT_EQ(cob_id::sdo_request(3), 0x603);
  EXPECT_EQ(cob_id::heartbeat(127), 0x77F);
  for (std::uint8_t node = 1; node <= 127; ++node) {
    EXPECT_EQ(cob_id::node_of(cob_id::tpdo1(node)), node);
  }
}

TEST(Nmt, OrdersAreTwoBytesToIdZero) {
  EXPECT_EQ(nmt_frame({NmtCommand::kResetCommunication, 4}), (hal::CanFrame{.id = 0, .size = 2, .data = {0x82, 4}}));
  EXPECT_EQ(sync_frame(), (hal::CanFrame{.id = 0x80, .size = 0, .data = {}}));
}

TEST(Nmt, AnOrderOfAWrongLengthIsNone) {
  for (std::uint8_t size = 0; size <= 8; ++size) {
    const hal::CanFrame frame{.id = 0, .size = size, .data = {0x01, 0}};
    EXPECT_EQ(parse_nmt(frame).has_value(), size == 2);
  }
}

TEST(Heartbeat, IsReadWithoutTheToggleBit) {
  const hal::CanFrame frame{.id = 0x701, .size = 1, .data = {0x85}};
  EXPECT_EQ(parse_heartbeat(frame), NmtState::kOperational);
  const hal::CanFrame pre_operational{.id = 0x701, .size = 1, .data = {0xFF}};
  EXPECT_EQ(parse_heartbeat(pre_operational), NmtState::kPreOperational);
}

TEST(Heartbeat, OfAWrongLengthIsNone) {
  for (std::uint8_t size = 0; size <= 8; ++size) {
    EXPECT_EQ(parse_heartbeat({.id = 0x701, .size = size, .data = {5}}).has_value(), size == 1);
  }
}

TEST(HeartbeatProducer, IsDueAtOnceThenEveryPeriodInPhase) {
  HeartbeatProducer producer(milliseconds(50));
  EXPECT_TRUE(producer.due(Instant(milliseconds(7))));
  EXPECT_FALSE(producer.due(Instant(milliseconds(56))));
  EXPECT_TRUE(producer.due(Instant(milliseconds(58))));
  EXPECT_TRUE(producer.due(Instant(milliseconds(107)))) << "the lateness of one is not handed on";
}

TEST(HeartbeatProducer, SkipsWhatALateCallerMissed) {
  HeartbeatProducer producer(milliseconds(50));
  EXPECT_TRUE(producer.due(Instant{}));
  EXPECT_TRUE(producer.due(Instant(milliseconds(1000))));
  EXPECT_FALSE(producer.due(Instant(milliseconds(1001))));
}

TEST(HeartbeatConsumer, BeginsWithTheFirstHeartbeat) {
  HeartbeatConsumer consumer(milliseconds(150));
  EXPECT_FALSE(consumer.lost(Instant(std::chrono::hours(1))));
  consumer.heard(Instant(milliseconds(10)));
  EXPECT_FALSE(consumer.lost(Instant(milliseconds(160))));
  EXPECT_TRUE(consumer.lost(Instant(milliseconds(161))));
  consumer.heard(Instant(milliseconds(161)));
  EXPECT_FALSE(consumer.lost(Instant(milliseconds(161))));
}

TEST(Emergency, GoesThereAndBack) {
  const auto parsed = parse_emergency(emergency_frame(2, {0x8130, 0x11}));
  ASSERT_TRUE(parsed.has_value());
  EXPECT_EQ(parsed->code, 0x8130);
  EXPECT_EQ(parsed->error_register, 0x11);
}

TEST(Emergency, IsNeitherSyncNorShort) {
  EXPECT_FALSE(parse_emergency({.id = 0x080, .size = 8, .data = {}}).has_value());
  EXPECT_FALSE(parse_emergency({.id = 0x081, .size = 7, .data = {}}).has_value());
}

TEST(Pdo, PacksControlwordAndTargetLittleEndian) {
  EXPECT_EQ(command_frame(0x201, {0x000F, -2}),
            (hal::CanFrame{.id = 0x201, .size = 6, .data = {0x0F, 0x00, 0xFE, 0xFF, 0xFF, 0xFF}}));
}

TEST(Pdo, ReadsStatuswordAndPositionOfExactlySixBytes) {
  hal::CanFrame frame{.id = 0x181, .size = 6, .data = {0x37, 0x12, 0xFF, 0xFF, 0xFF, 0xFF}};
  const auto status = parse_status(frame);
  ASSERT_TRUE(status.has_value());
  EXPECT_EQ(status->statusword, 0x1237);
  EXPECT_EQ(status->position, -1);
  for (frame.size = 0; frame.size <= 8; ++frame.size) {
    EXPECT_EQ(parse_status(frame).has_value(), frame.size == 6);
  }
}

}  // namespace
}  // namespace ivo::drivers
