#include "hal/sim/virtual_bus.hpp"

#include <gtest/gtest.h>

#include <array>

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

}  // namespace
}  // namespace ivo::hal
