#include "hal/linux/socketcan_bus.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>

#include "config/rates.hpp"
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

const can_frame kBusError = error_frame(CAN_ERR_BUSERROR | CAN_ERR_PROT, 0);

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

TEST_F(SocketCanBusOnAWire, KeepsWhatNobodyTakesUntilItIsOld) {
  const CanFrame frame{.id = 0x201, .size = 6, .data = {}};
  std::uint64_t tries = 0;
  while (bus_.send({&frame, 1}, Instant{}) == 1) {
    ++tries;
  }
  EXPECT_EQ(bus_.counters().sent, tries);
  EXPECT_EQ(bus_.details().queue_full, 1U);
  EXPECT_FALSE(bus_.just_sent(0x201));
  const Instant later = Instant{} + rates::kTransmitAge + Duration(1);
  EXPECT_EQ(bus_.send({}, later), 0U);
  EXPECT_EQ(bus_.counters().send_dropped, 1U);
  EXPECT_EQ(bus_.counters().sent, tries);
}

TEST_F(SocketCanBusOnAWire, SendsTheNewestOfWhatNobodyTookWhenThereIsRoomAgain) {
  CanFrame frame{.id = 0x201, .size = 1, .data = {1}};
  while (bus_.send({&frame, 1}, Instant{}) == 1) {
  }
  frame.data[0] = 2;
  EXPECT_EQ(bus_.send({&frame, 1}, Instant{}), 0U);
  can_frame raw{};
  while (recv(far_.get(), &raw, sizeof raw, MSG_DONTWAIT) > 0) {
    EXPECT_EQ(raw.data[0], 1);
  }
  EXPECT_EQ(bus_.send({}, Instant{} + rates::kTransmitAge), 0U);
  EXPECT_TRUE(bus_.just_sent(0x201));
  ASSERT_EQ(recv(far_.get(), &raw, sizeof raw, MSG_DONTWAIT), static_cast<ssize_t>(sizeof raw));
  EXPECT_EQ(raw.data[0], 2);
  EXPECT_EQ(bus_.counters().send_replaced, 1U);
}

TEST_F(SocketCanBusOnAWire, WhileOffHandsNothingOverAndAfterwardsNothingOld) {
  const CanFrame velocity{.id = 0x201, .size = 6, .data = {0x0F}};
  put(error_frame(CAN_ERR_BUSOFF, 0));
  EXPECT_EQ(received(), 0U);
  EXPECT_EQ(bus_.send({&velocity, 1}, Instant{}), 0U);
  EXPECT_EQ(bus_.counters().send_dropped, 1U);
  put(error_frame(CAN_ERR_RESTARTED, 0));
  EXPECT_EQ(received(), 0U);
  EXPECT_EQ(bus_.send({}, Instant{}), 0U);
  can_frame raw{};
  EXPECT_LT(recv(far_.get(), &raw, sizeof raw, MSG_DONTWAIT), 0) << "a velocity from before bus-off";
  EXPECT_EQ(bus_.send({&velocity, 1}, Instant{}), 1U);
}

TEST_F(SocketCanBusOnAWire, AFloodOfErrorFramesHidesNoDataFrame) {
  const int room = 1 << 20;
  ASSERT_EQ(setsockopt(far_.get(), SOL_SOCKET, SO_SNDBUF, &room, sizeof room), 0);
  can_frame data{};
  data.can_id = 0x181;
  data.can_dlc = 1;
  int errors = 0;
  for (std::uint8_t i = 0; i < 5; ++i) {
    for (int flood = 0; flood < 40; ++flood) {
      if (send(far_.get(), &kBusError, sizeof kBusError, MSG_DONTWAIT) > 0) {
        ++errors;
      }
    }
    data.data[0] = i;
    put(data);
  }
  std::array<ReceivedFrame, 8> frames;
  ASSERT_EQ(bus_.receive(frames, Instant{}), 5U) << "in one call";
  EXPECT_EQ(frames[4].frame.data[0], 4);
  EXPECT_EQ(bus_.details().errors.bus_error, static_cast<std::uint64_t>(errors));
  EXPECT_GT(errors, 100);
  EXPECT_EQ(bus_.state(), BusState::kActive);
}

TEST_F(SocketCanBusOnAWire, WhatTheCallerHasNoRoomForComesNextWithoutLosingOrder) {
  can_frame data{};
  data.can_id = 0x181;
  data.can_dlc = 1;
  for (std::uint8_t i = 0; i < 20; ++i) {
    data.data[0] = i;
    put(data);
  }
  std::array<ReceivedFrame, 8> frames;
  for (const std::size_t expected : {8U, 8U, 4U, 0U}) {
    static std::uint8_t next = 0;
    ASSERT_EQ(bus_.receive(frames, Instant{}), expected);
    for (std::size_t i = 0; i < expected; ++i) {
      EXPECT_EQ(frames[i].frame.data[0], next++);
    }
  }
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

TEST(ErrorFrame, BusOffOutweighsWhatElseTheFrameSays) {
  EXPECT_EQ(state_told_by(error_frame(CAN_ERR_BUSOFF | CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING)), BusState::kOff);
}

TEST(ErrorFrame, OfAWrongLengthTellsNothingOfTheController) {
  can_frame frame = error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING);
  frame.can_dlc = 1;
  EXPECT_EQ(state_told_by(frame), std::nullopt);
}

TEST(ErrorFrame, IsCountedByClassWithItsDetails) {
  ErrorCounters counters;
  can_frame frame = error_frame(CAN_ERR_LOSTARB | CAN_ERR_PROT | CAN_ERR_TRX | CAN_ERR_CNT | CAN_ERR_ACK, 0);
  frame.data[0] = 17;
  frame.data[2] = CAN_ERR_PROT_STUFF;
  frame.data[3] = CAN_ERR_PROT_LOC_DATA;
  frame.data[4] = CAN_ERR_TRX_CANL_NO_WIRE;
  frame.data[6] = 136;
  frame.data[7] = 9;
  count_error(frame, counters);
  EXPECT_EQ(counters.lost_arbitration, 1U);
  EXPECT_EQ(counters.last_arbitration_bit, 17);
  EXPECT_EQ(counters.protocol, 1U);
  EXPECT_EQ(counters.last_protocol_kind, CAN_ERR_PROT_STUFF);
  EXPECT_EQ(counters.last_protocol_place, CAN_ERR_PROT_LOC_DATA);
  EXPECT_EQ(counters.transceiver, 1U);
  EXPECT_EQ(counters.last_transceiver_state, CAN_ERR_TRX_CANL_NO_WIRE);
  EXPECT_EQ(counters.no_acknowledgement, 1U);
  EXPECT_EQ(counters.transmit_errors, 136);
  EXPECT_EQ(counters.receive_errors, 9);
  EXPECT_EQ(counters.bus_error, 0U);
  count_error(error_frame(CAN_ERR_TX_TIMEOUT | CAN_ERR_BUSERROR, 0), counters);
  EXPECT_EQ(counters.transmit_timeout, 1U);
  EXPECT_EQ(counters.bus_error, 1U);
  EXPECT_EQ(counters.transmit_errors, 136) << "not told anew";
}

TEST(ErrorFrame, OfTheControllerIsCountedByWhatItSays) {
  ErrorCounters counters;
  count_error(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW | CAN_ERR_CRTL_TX_PASSIVE), counters);
  count_error(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_OVERFLOW | CAN_ERR_CRTL_RX_WARNING), counters);
  count_error(error_frame(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE), counters);
  EXPECT_EQ(counters.receive_overflow, 1U);
  EXPECT_EQ(counters.transmit_overflow, 1U);
  EXPECT_EQ(counters.controller_passive, 1U);
  EXPECT_EQ(counters.controller_warning, 1U);
  EXPECT_EQ(counters.controller_active, 1U);
}

TEST(ErrorFrame, OfAWrongLengthIsCountedAsSuchAndByItsClass) {
  ErrorCounters counters;
  can_frame frame = error_frame(CAN_ERR_BUSOFF | CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW);
  frame.can_dlc = 1;
  count_error(frame, counters);
  EXPECT_EQ(counters.bus_off, 1U);
  EXPECT_EQ(counters.malformed, 1U);
  EXPECT_EQ(counters.receive_overflow, 0U);
}

}  // namespace
}  // namespace ivo::hal
