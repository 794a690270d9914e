// SocketCanBus on a real interface: what it hears, what it says of it, and what it confirms.
#include <linux/can/error.h>
#include <time.h>

#include <chrono>
#include <cstdlib>

#include "tests/unit/hal/vcan_rig.hpp"

namespace ivo::hal {
namespace {

using std::chrono::milliseconds;
using SocketCanBusOnVcan = OnVcan;

constexpr CanFrame kTarget{.id = 0x201, .size = 6, .data = {0x0F}};

SocketCanBus opened(const SocketCanBus::Options& options = {}) {
  Result<SocketCanBus> bus = SocketCanBus::open("vcan7", options);
  EXPECT_TRUE(bus.ok()) << bus.error().message;
  return std::move(bus).value();
}

TEST_F(SocketCanBusOnVcan, HearsPlainDataFramesOnly) {
  SocketCanBus bus = opened();
  const Stranger stranger(kLink);
  ASSERT_TRUE(stranger.put(0x181 | CAN_EFF_FLAG));
  ASSERT_TRUE(stranger.put(0x181 | CAN_RTR_FLAG));
  let_arrive();
  EXPECT_FALSE(bus.wait_readable(Duration::zero())) << "the kernel's filter keeps them out";
  ASSERT_TRUE(stranger.put(0x181));
  EXPECT_EQ(ids(bus), (std::vector<std::uint16_t>{0x181}));
}

TEST_F(SocketCanBusOnVcan, DoesNotHearFdFrames) {
  SocketCanBus bus = opened();
  const Stranger stranger(kLink);
  const int on = 1;
  ASSERT_EQ(setsockopt(stranger.get(), SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on), 0);
  canfd_frame frame{};
  frame.can_id = 0x181;
  frame.len = 12;
  ASSERT_EQ(write(stranger.get(), &frame, CANFD_MTU), static_cast<ssize_t>(CANFD_MTU));
  EXPECT_TRUE(ids(bus).empty());
  EXPECT_EQ(bus.details().malformed, 0U);
}

TEST_F(SocketCanBusOnVcan, HearsExactlyTheIdsAsked) {
  const std::array<std::uint16_t, 4> wanted{0x000, 0x181, 0x7FF, 0x581};
  SocketCanBus bus = opened({.ids = wanted});
  const Stranger stranger(kLink);
  for (canid_t id = 0; id < 0x800; ++id) {
    ASSERT_TRUE(stranger.put(id));
    ASSERT_TRUE(stranger.put(id | CAN_RTR_FLAG));
    ASSERT_TRUE(stranger.put(id | CAN_EFF_FLAG));
  }
  EXPECT_EQ(ids(bus), (std::vector<std::uint16_t>{0x000, 0x181, 0x581, 0x7FF}));
}

TEST_F(SocketCanBusOnVcan, HearsAsManyIdsAsTheKernelFiltersAndRefusesMore) {
  std::vector<std::uint16_t> many;
  for (std::uint16_t id = 0; id < 512; ++id) {
    many.push_back(id);
  }
  SocketCanBus bus = opened({.ids = many});
  const Stranger stranger(kLink);
  ASSERT_TRUE(stranger.put(511));
  ASSERT_TRUE(stranger.put(512));
  EXPECT_EQ(ids(bus), (std::vector<std::uint16_t>{511}));
  many.push_back(512);
  EXPECT_EQ(SocketCanBus::open(kLink, {.ids = many}).error().message,
            "CAN interface \"vcan7\": 513 COB-IDs to hear; expected at most 512");
  const std::array<std::uint16_t, 1> impossible{0x800};
  EXPECT_EQ(SocketCanBus::open(kLink, {.ids = impossible}).error().message,
            "CAN interface \"vcan7\": COB-ID 2048 to hear; expected at most 2047");
}

TEST_F(SocketCanBusOnVcan, ErrorFramesAreToldWhateverTheIds) {
  const std::array<std::uint16_t, 1> wanted{0x181};
  SocketCanBus bus = opened({.ids = wanted});
  ASSERT_TRUE(shell("cansend vcan7 20000040#0000000000000000"));
  EXPECT_TRUE(ids(bus).empty());
  EXPECT_EQ(bus.state(), BusState::kOff);
  EXPECT_EQ(bus.details().errors.bus_off, 1U);
  ASSERT_TRUE(shell("cansend vcan7 20000100#0000000000000000"));
  EXPECT_TRUE(ids(bus).empty());
  EXPECT_EQ(bus.state(), BusState::kActive);
  ASSERT_TRUE(shell("cansend vcan7 20000204#0020000000008800"));
  EXPECT_TRUE(ids(bus).empty());
  EXPECT_EQ(bus.state(), BusState::kPassive);
  EXPECT_EQ(bus.details().errors.transmit_errors, 0x88);
}

TEST_F(SocketCanBusOnVcan, TellsAnotherProgramOnThisHostFromItsOwnFrames) {
  SocketCanBus bus = opened();
  SocketCanBus second = opened();
  ASSERT_EQ(bus.send({&kTarget, 1}, Instant{}), 1U);
  const std::vector<ReceivedFrame> heard = receive(second);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].frame, kTarget);
  EXPECT_EQ(heard[0].origin, FrameOrigin::kThisHost);
  EXPECT_EQ(bus.counters().confirmed, 0U) << "not looked yet";
  EXPECT_TRUE(receive(bus).empty()) << "its own frame is no data";
  EXPECT_EQ(bus.counters().confirmed, 1U);
}

TEST_F(SocketCanBusOnVcan, HearsWithinItsIdsWhoElseSendsThem) {
  const std::array<std::uint16_t, 1> wanted{0x201};
  SocketCanBus bus = opened({.ids = wanted});
  const Stranger stranger(kLink);
  ASSERT_EQ(bus.send({&kTarget, 1}, Instant{}), 1U);
  ASSERT_TRUE(stranger.put(0x201));
  const std::vector<ReceivedFrame> heard = receive(bus);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].origin, FrameOrigin::kThisHost);
  EXPECT_EQ(bus.counters().confirmed, 1U);
}

TEST_F(SocketCanBusOnVcan, WhatItDoesNotHearItTakesForConfirmed) {
  const std::array<std::uint16_t, 1> wanted{0x181};
  SocketCanBus bus = opened({.ids = wanted});
  EXPECT_EQ(bus.send({&kTarget, 1}, Instant{}), 1U);
  EXPECT_EQ(bus.send({&kTarget, 1}, Instant{}), 1U);
  EXPECT_EQ(bus.counters().confirmed, 2U);
}

TEST_F(SocketCanBusOnVcan, WithoutConfirmationTwoFramesOfAnIdGoTogether) {
  SocketCanBus bus = opened({.confirm = false});
  const Stranger stranger(kLink);
  const std::array<CanFrame, 2> twice{kTarget, kTarget};
  EXPECT_EQ(bus.send(twice, Instant{}), 2U);
  EXPECT_EQ(stranger.heard().size(), 2U);
  EXPECT_TRUE(receive(bus).empty());
}

TEST_F(SocketCanBusOnVcan, CountsWhatItsSocketLost) {
  SocketCanBus bus = opened();
  const Stranger stranger(kLink);
  constexpr int kFlood = 20'000;
  for (int i = 0; i < kFlood; ++i) {
    ASSERT_TRUE(stranger.put(0x181));
  }
  const std::size_t arrived = receive(bus).size();
  EXPECT_GT(arrived, 1'000U);
  ASSERT_TRUE(stranger.put(0x181));  // the losses are told with the next frame that gets through
  EXPECT_EQ(receive(bus).size(), 1U);
  EXPECT_EQ(bus.counters().receive_dropped, kFlood - arrived);
}

TEST_F(SocketCanBusOnVcan, StampsStayBetweenTwoCallsWhenTheWallClockIsSet) {
  if (std::getenv("IVO_OWN_CLOCK") == nullptr) {
    GTEST_SKIP() << "needs a clock of its own: toolchain/vcan in a guest";
  }
  SocketCanBus bus = opened();
  const Stranger stranger(kLink);
  Instant before{};
  (void)receive(bus, before);
  std::uint64_t clamped = 0;
  for (int cycle = 1; cycle <= 12; ++cycle) {
    ASSERT_TRUE(stranger.put(0x181));
    const bool step = cycle % 3 == 0;
    if (step) {
      timespec now{};
      clock_gettime(CLOCK_REALTIME, &now);
      now.tv_sec += cycle % 2 == 0 ? 3600 : -3600;
      ASSERT_EQ(clock_settime(CLOCK_REALTIME, &now), 0);
    }
    const Instant now{cycle * std::chrono::minutes(1)};  // more than any machine stands still
    const std::vector<ReceivedFrame> heard = receive(bus, now);
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_GE(heard[0].at, before);
    EXPECT_LE(heard[0].at, now);
    EXPECT_GT(heard[0].at + std::chrono::seconds(step ? 120 : 59), now) << "without a step it is as old as it is";
    clamped += step ? 1 : 0;
    before = now;
  }
  EXPECT_EQ(bus.details().stamps_clamped, clamped);
}

TEST_F(SocketCanBusOnVcan, KnowsTheInterface) {
  const SocketCanBus bus = opened({.bit_rate_bps = 1'000'000});
  EXPECT_EQ(bus.facts().name, kLink);
  EXPECT_EQ(bus.facts().kind, InterfaceFacts::Kind::kVcan);
  EXPECT_EQ(bus.facts().bit_rate_bps, 0U) << "it has none, so none is wrong";
  EXPECT_TRUE(bus.facts().carries_can);
  EXPECT_TRUE(bus.facts().up);
  EXPECT_EQ(bus.facts().mtu, 72U);
}

TEST_F(SocketCanBusOnVcan, KnowsAPairOfInterfacesToo) {
  ASSERT_TRUE(shell("ip link add vxcan8 type vxcan peer name vxcan9"));
  const Result<InterfaceFacts> facts = interface_facts("vxcan8");
  ASSERT_TRUE(facts.ok());
  EXPECT_EQ(facts.value().kind, InterfaceFacts::Kind::kVxcan);
  EXPECT_FALSE(facts.value().up);
  ASSERT_TRUE(shell("ip link del vxcan8"));
}

}  // namespace
}  // namespace ivo::hal
