#include "hal/sim/virtual_bus.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>

#include "config/rates.hpp"

namespace ivo::hal {
namespace {

constexpr CanFrame kFrame{.id = 0x181, .size = 2, .data = {1, 2}};

TEST(VirtualBus, ReachesEveryOtherPort) {
  VirtualBus bus;
  bus.port(3).send({&kFrame, 1}, Instant{});
  std::array<ReceivedFrame, 2> frames;
  for (std::size_t i = 0; i < VirtualBus::kPorts; ++i) {
    EXPECT_EQ(bus.port(i).receive(frames, Instant{}), i == 3 ? 0U : 1U) << "port " << i;
  }
}

TEST(VirtualBus, DropsAndCountsWhatAQueueCannotHold) {
  VirtualBus bus;
  for (std::size_t i = 0; i < VirtualBus::kQueueFrames + 7; ++i) {
    EXPECT_EQ(bus.port(0).send({&kFrame, 1}, Instant{}), 1U);
  }
  EXPECT_EQ(bus.port(1).counters().receive_dropped, 7U);
  std::array<ReceivedFrame, VirtualBus::kQueueFrames + 7> frames;
  EXPECT_EQ(bus.port(1).receive(frames, Instant{}), VirtualBus::kQueueFrames);
}

TEST(VirtualBus, PassesNothingOnThroughAPortThatIsOff) {
  for (const BusState state : {BusState::kOff, BusState::kDown, BusState::kRemoved}) {
    VirtualBus bus;
    std::array<ReceivedFrame, 2> frames;
    bus.port(1).send({&kFrame, 1}, Instant{});
    bus.set_state(0, state);
    bus.port(1).send({&kFrame, 1}, Instant{});
    EXPECT_EQ(bus.port(0).state(), state);
    EXPECT_EQ(bus.port(0).receive(frames, Instant{}), 0U);
    EXPECT_EQ(bus.port(0).send({&kFrame, 1}, Instant{}), 0U);
    EXPECT_EQ(bus.port(0).counters().send_dropped, 1U);
    bus.set_state(0, BusState::kActive);
    EXPECT_EQ(bus.port(0).send({&kFrame, 1}, Instant{}), 1U);
  }
}

TEST(VirtualBus, StillWorksWhilePassive) {
  VirtualBus bus;
  bus.set_state(0, BusState::kPassive);
  EXPECT_EQ(bus.port(0).send({&kFrame, 1}, Instant{}), 1U);
}

TEST(VirtualBus, ANarrowPortKeepsTheNewestAndDropsTheOld) {
  VirtualBus bus;
  bus.set_room(0, 1);
  const std::array<CanFrame, 3> frames{CanFrame{.id = 0x201, .size = 1, .data = {1}},
                                       CanFrame{.id = 0x202, .size = 1, .data = {1}},
                                       CanFrame{.id = 0x203, .size = 1, .data = {1}}};
  EXPECT_EQ(bus.port(0).send(frames, Instant{}), 1U);
  const CanFrame newer{.id = 0x202, .size = 1, .data = {2}};
  EXPECT_EQ(bus.port(0).send({&newer, 1}, Instant{}), 1U);
  bus.set_room(0, 100);
  EXPECT_EQ(bus.port(0).send({}, Instant{} + rates::kTransmitAge + Duration(1)), 0U);
  std::array<ReceivedFrame, 8> received;
  ASSERT_EQ(bus.port(1).receive(received, Instant{}), 2U);
  EXPECT_EQ(received[1].frame, newer);
  EXPECT_EQ(bus.port(0).counters().send_replaced, 1U);
  EXPECT_EQ(bus.port(0).counters().send_dropped, 1U);
}

TEST(VirtualBus, LosesTheNextFramesOfAnIdAndNoOther) {
  VirtualBus bus;
  bus.lose(kFrame.id, 2);
  const CanFrame other{.id = 0x182, .size = 0, .data = {}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(bus.port(0).send({&kFrame, 1}, Instant{}), 1U);
    EXPECT_EQ(bus.port(0).send({&other, 1}, Instant{}), 1U);
  }
  std::array<ReceivedFrame, 8> frames;
  ASSERT_EQ(bus.port(1).receive(frames, Instant{}), 4U);
  EXPECT_EQ(frames[2].frame, kFrame);
}

TEST(VirtualBus, WithLatencyFramesArriveLaterAndInOrder) {
  using std::chrono::milliseconds;
  VirtualBus bus;
  bus.set_latency(milliseconds(3));
  bus.port(0).send({&kFrame, 1}, Instant(milliseconds(10)));
  bus.port(0).send({&kFrame, 1}, Instant(milliseconds(12)));
  std::array<ReceivedFrame, 8> frames;
  EXPECT_EQ(bus.port(1).receive(frames, Instant(milliseconds(12))), 0U);
  ASSERT_EQ(bus.port(1).receive(frames, Instant(milliseconds(14))), 1U);
  EXPECT_EQ(frames[0].at, Instant(milliseconds(13)));
  EXPECT_EQ(bus.port(1).receive(frames, Instant(milliseconds(16))), 1U);
}

TEST(VirtualBus, AFrameFromNowhereReachesEveryPortWithItsOrigin) {
  VirtualBus bus;
  bus.inject(kFrame, Instant{}, FrameOrigin::kThisHost);
  std::array<ReceivedFrame, 2> frames;
  for (std::size_t i = 0; i < VirtualBus::kPorts; ++i) {
    ASSERT_EQ(bus.port(i).receive(frames, Instant{}), 1U);
    EXPECT_EQ(frames[0].origin, FrameOrigin::kThisHost);
  }
}

}  // namespace
}  // namespace ivo::hal
