#include "hal/linux/socketcan_bus.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>

#include "hal/linux/error_frame.hpp"

namespace ivo::hal {
namespace {

bool kernel_has_can() { return FileDescriptor(socket(AF_CAN, SOCK_RAW, 1)).valid(); }

can_frame error_frame(canid_t error_class, std::uint8_t controller) {
  can_frame frame{};
  frame.can_id = CAN_ERR_FLAG | error_class;
  frame.can_dlc = CAN_ERR_DLC;
  frame.data[1] = controller;
  return frame;
}

class Wire : public testing::Test {
 protected:
  void put(const void* bytes, std::size_t size) {
    ASSERT_EQ(send(far_.get(), bytes, size, 0), static_cast<ssize_t>(size));
  }
  void put(const can_frame& frame) { put(&frame, sizeof frame); }
  std::size_t received() {
    std::array<ReceivedFrame, 8> frames;
    return bus_.receive(frames, Instant{});
  }

  std::array<int, 2> fds_ = [] {
    std::array<int, 2> fds{};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, fds.data()), 0);
    return fds;
  }();
  SocketCanBus bus_{FileDescriptor(fds_[0])};
  FileDescriptor far_{fds_[1]};
};

using SocketCanBusOnAWire = Wire;

TEST(SocketCanBus, RefusesAKernelWithoutCanInOneLine) {
  if (kernel_has_can()) {
    GTEST_SKIP() << "this kernel has CAN";
  }
  EXPECT_EQ(SocketCanBus::open("can0").error().message,
            "this kernel has no CAN sockets (AF_CAN): load the can module or use the virtual bus");
}

TEST(SocketCanBus, RefusesAnInterfaceThatDoesNotExist) {
  if (!kernel_has_can()) {
    GTEST_SKIP() << "this kernel has no CAN";
  }
  for (const char* name : {"can7", "", "a-name-that-no-interface-can-have"}) {
    EXPECT_EQ(
        SocketCanBus::open(name).error().message,
        std::string("no CAN interface \"") + name + "\": `ip link show type can` (or vcan) lists those there are");
  }
}

TEST(SocketCanBus, RefusesAnInterfaceThatIsNotCan) {
  if (!kernel_has_can()) {
    GTEST_SKIP() << "this kernel has no CAN";
  }
  EXPECT_EQ(SocketCanBus::open("lo").error().message,
            "\"lo\" is not a CAN interface: `ip link show type can` (or vcan) lists those there are");
}

TEST_F(SocketCanBusOnAWire, PassesOverExtendedAndRemoteFrames) {
  can_frame frame{};
  frame.can_dlc = 1;
  frame.can_id = 0x181 | CAN_EFF_FLAG;
  put(frame);
  frame.can_id = 0x181 | CAN_RTR_FLAG;
  put(frame);
  EXPECT_EQ(received(), 0U);
  frame.can_id = 0x181;
  put(frame);
  EXPECT_EQ(received(), 1U);
}

TEST_F(SocketCanBusOnAWire, PassesOverShortMessagesAndImpossibleLengths) {
  can_frame frame{};
  frame.can_id = 0x181;
  put(&frame, 5);
  frame.can_dlc = 9;
  put(frame);
  EXPECT_EQ(received(), 0U);
}

TEST_F(SocketCanBusOnAWire, TellsTheStateThatErrorFramesTell) {
  const auto state_after = [this](const can_frame& frame) {
    put(frame);
    EXPECT_EQ(received(), 0U) << "an error frame is no data";
    return bus_.state();
  };
  EXPECT_EQ(state_after(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING)), BusState::kWarning);
  EXPECT_EQ(state_after(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE)), BusState::kPassive);
  EXPECT_EQ(state_after(error_frame(CAN_ERR_LOSTARB, 0)), BusState::kPassive);
  EXPECT_EQ(state_after(error_frame(CAN_ERR_BUSOFF, 0)), BusState::kOff);
  EXPECT_EQ(state_after(error_frame(CAN_ERR_RESTARTED, 0)), BusState::kActive);
  EXPECT_EQ(state_after(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_WARNING)), BusState::kWarning);
  EXPECT_EQ(state_after(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE)), BusState::kActive);
}

TEST_F(SocketCanBusOnAWire, DropsAndCountsWhenNobodyTakes) {
  const CanFrame frame{.id = 0x201, .size = 6, .data = {}};
  std::uint64_t tries = 0;
  while (bus_.send({&frame, 1}, Instant{}) == 1) {
    ++tries;
  }
  EXPECT_EQ(bus_.counters().sent, tries);
  EXPECT_EQ(bus_.counters().send_dropped, 1U);
}

TEST_F(SocketCanBusOnAWire, WaitsOnlyUntilThereIsSomething) {
  EXPECT_FALSE(bus_.wait_readable(Duration::zero()));
  put(can_frame{});
  EXPECT_TRUE(bus_.wait_readable(std::chrono::seconds(60)));
}

TEST_F(SocketCanBusOnAWire, WorksOnWhenMoved) {
  SocketCanBus moved = std::move(bus_);
  put(can_frame{});
  std::array<ReceivedFrame, 8> frames;
  EXPECT_EQ(moved.receive(frames, Instant{}), 1U);
}

/// A raw socket on vcan0 that sends what it likes, beside the bus under test.
class SocketCanBusOnVcan : public testing::Test {
 protected:
  void SetUp() override {
    if (!bus_.ok()) {
      GTEST_SKIP() << bus_.error().message;
    }
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex("vcan0"));
    ASSERT_EQ(bind(stranger_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  void put(canid_t id) {
    can_frame frame{};
    frame.can_id = id;
    frame.can_dlc = 8;
    ASSERT_EQ(write(stranger_.get(), &frame, sizeof frame), static_cast<ssize_t>(sizeof frame));
  }

  Result<SocketCanBus> bus_ = SocketCanBus::open("vcan0");
  FileDescriptor stranger_{socket(AF_CAN, SOCK_RAW, CAN_RAW)};
  std::array<ReceivedFrame, 8> frames_;
};

TEST_F(SocketCanBusOnVcan, HearsPlainDataFramesOnly) {
  put(0x181 | CAN_EFF_FLAG);
  put(0x181 | CAN_RTR_FLAG);
  EXPECT_FALSE(bus_.value().wait_readable(Duration::zero())) << "the kernel's filter keeps them out";
  put(0x181);
  EXPECT_EQ(bus_.value().receive(frames_, Instant{}), 1U);
  EXPECT_EQ(frames_[0].frame.id, 0x181);
}

TEST_F(SocketCanBusOnVcan, LearnsOfBusOffAndRestartFromErrorFrames) {
  put(CAN_ERR_FLAG | CAN_ERR_BUSOFF);
  EXPECT_EQ(bus_.value().receive(frames_, Instant{}), 0U);
  EXPECT_EQ(bus_.value().state(), BusState::kOff);
  put(CAN_ERR_FLAG | CAN_ERR_RESTARTED);
  EXPECT_EQ(bus_.value().receive(frames_, Instant{}), 0U);
  EXPECT_EQ(bus_.value().state(), BusState::kActive);
}

TEST(ErrorFrame, BusOffOutweighsWhatElseTheFrameSays) {
  EXPECT_EQ(state_told_by(error_frame(CAN_ERR_BUSOFF | CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING)), BusState::kOff);
}

TEST(ErrorFrame, OfAWrongLengthTellsNothingOfTheController) {
  can_frame frame = error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING);
  frame.can_dlc = 1;
  EXPECT_EQ(state_told_by(frame), std::nullopt);
}

}  // namespace
}  // namespace ivo::hal
