// A real interface whose queue is slow: nothing old leaves it.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "config/rates.hpp"
#include "tests/unit/hal/vcan_rig.hpp"

namespace ivo::hal {
namespace {

using std::chrono::milliseconds;

constexpr int kCycles = 300;
constexpr std::array<std::uint16_t, 5> kIds{0x080, 0x201, 0x202, 0x203, 0x204};

std::array<CanFrame, kIds.size()> frames_of(std::uint32_t cycle) {
  std::array<CanFrame, kIds.size()> frames;
  for (std::size_t i = 0; i < kIds.size(); ++i) {
    frames[i] = {.id = kIds[i], .size = 8, .data = {}};
    std::memcpy(frames[i].data.data(), &cycle, sizeof cycle);
  }
  return frames;
}

std::uint32_t cycle_of(const can_frame& frame) {
  std::uint32_t cycle = 0;
  std::memcpy(&cycle, frame.data, sizeof cycle);
  return cycle;
}

class Throttled : public OnVcan {
 protected:
  /// A frame is 16 bytes to the kernel's queues.
  void throttle(const std::string& rate, int queued_frames) {
    if (!shell("tc qdisc add dev vcan7 root tbf rate " + rate + " burst 32 limit " +
               std::to_string(16 * queued_frames))) {
      GTEST_SKIP() << "no tc, or no tbf in this kernel";
    }
  }
};

using ThrottledBusTest = Throttled;

TEST_F(ThrottledBusTest, TheQueueNeverHoldsTwoFramesOfAnIdAndNoneIsOld) {
  throttle("32kbit", 100);  // 4 ms a frame, room for all that a careless sender would queue
  SocketCanBus bus = SocketCanBus::open(kLink).value();
  const Stranger drive(kLink);
  std::map<canid_t, std::uint32_t> last;
  std::uint32_t late = 0;
  const auto listen = [&](std::uint32_t cycle) {
    for (const can_frame& frame : drive.heard()) {
      EXPECT_TRUE(last.count(frame.can_id) == 0 || last[frame.can_id] < cycle_of(frame)) << "out of order";
      last[frame.can_id] = cycle_of(frame);
      late = std::max(late, cycle - cycle_of(frame));
    }
  };
  Instant now{};
  for (std::uint32_t cycle = 0; cycle < kCycles; ++cycle) {
    (void)receive(bus, now);
    listen(cycle);
    (void)bus.send(frames_of(cycle), now);
    (void)bus.wait_readable(milliseconds(2));
    now += rates::kCycle;
  }
  // Now silence: what still comes was in the queue, one frame an id.
  std::map<canid_t, int> still_queued;
  while (bus.counters().confirmed < bus.counters().sent) {
    (void)bus.wait_readable(milliseconds(100));
    (void)receive(bus, now);
  }
  for (const can_frame& frame : drive.heard()) {
    EXPECT_LE(++still_queued[frame.can_id], 1) << std::hex << frame.can_id;
  }
  EXPECT_GT(bus.counters().send_replaced + bus.counters().send_dropped, 100U) << "the queue was slow";
  EXPECT_GT(last.size(), 4U);
}

TEST_F(ThrottledBusTest, AFullQueueIsCountedAndTheRestGoesOutLater) {
  throttle("1kbit", 1);  // 128 ms a frame: none leaves while the others are given
  SocketCanBus bus = SocketCanBus::open(kLink).value();
  const std::size_t taken = bus.send(frames_of(1), Instant{});
  EXPECT_GE(taken, 1U);
  EXPECT_LT(taken, kIds.size());
  EXPECT_EQ(bus.details().queue_full, 1U);
  EXPECT_EQ(bus.state(), BusState::kActive) << "a full queue is no lost bus";
  while (bus.counters().sent < kIds.size()) {
    (void)bus.wait_readable(milliseconds(10));
    (void)receive(bus, Instant{});
    EXPECT_EQ(bus.send({}, Instant{} + rates::kTransmitAge), 0U) << "none of them was given now";
  }
}

TEST_F(ThrottledBusTest, WhatIsHandedOverIsWhatAnotherNodeHearsInTheSameOrder) {
  throttle("32kbit", 3);
  SocketCanBus bus = SocketCanBus::open(kLink).value();
  const Stranger drive(kLink);
  using Seen = std::pair<canid_t, std::uint32_t>;
  std::vector<Seen> handed_over;
  std::vector<Seen> heard;
  std::uint64_t left_over = 0;
  const auto listen = [&] {
    for (const can_frame& frame : drive.heard()) {
      heard.emplace_back(frame.can_id, cycle_of(frame));
    }
  };
  Instant now{};
  for (std::uint32_t cycle = 0; cycle < kCycles; ++cycle) {
    (void)receive(bus, now);
    listen();
    const auto frames = frames_of(cycle);  // every other cycle, so that something is left over for those between
    const std::size_t given_now = bus.send(std::span(frames).first(cycle % 2 == 0 ? frames.size() : 0), now);
    left_over += bus.handed_over().size() - given_now;
    for (const CanFrame& frame : bus.handed_over()) {
      std::uint32_t given_in = 0;
      std::memcpy(&given_in, frame.data.data(), sizeof given_in);
      handed_over.emplace_back(frame.id, given_in);
    }
    (void)bus.wait_readable(milliseconds(2));
    now += rates::kCycle;
  }
  while (bus.counters().confirmed < bus.counters().sent) {
    (void)bus.wait_readable(milliseconds(100));
    (void)receive(bus, now);
  }
  listen();
  EXPECT_EQ(handed_over, heard);
  EXPECT_EQ(handed_over.size(), bus.counters().sent);
  EXPECT_GT(left_over, 0U) << "some waited";
  EXPECT_GT(bus.counters().send_replaced + bus.counters().send_dropped, 0U) << "some in vain";
}

TEST_F(ThrottledBusTest, WhatAFullQueueDidNotTakeInTimeNeverGoesOut) {
  throttle("32kbit", 1);
  SocketCanBus bus = SocketCanBus::open(kLink).value();
  const Stranger drive(kLink);
  const std::size_t taken = bus.send(frames_of(1), Instant{});
  while (bus.counters().confirmed < taken) {
    (void)bus.wait_readable(milliseconds(10));
    (void)receive(bus, Instant{});
  }
  EXPECT_EQ(bus.send({}, Instant{} + rates::kTransmitAge + Duration(1)), 0U);
  EXPECT_EQ(bus.counters().send_dropped, kIds.size() - taken);
  EXPECT_EQ(bus.counters().sent, taken);
  EXPECT_EQ(drive.heard().size(), taken);
}

TEST_F(ThrottledBusTest, AQueueThatNothingLeavesIsALostBusUntilSomethingDoes) {
  if (!shell("tc qdisc add dev vcan7 root netem delay 5s")) {
    GTEST_SKIP() << "no tc, or no netem in this kernel";
  }
  SocketCanBus bus = SocketCanBus::open(kLink).value();
  EXPECT_EQ(bus.send(frames_of(1), Instant{}), kIds.size());
  (void)receive(bus, Instant{} + rates::kTransmitTimeout - Duration(1));
  EXPECT_EQ(bus.state(), BusState::kActive);
  (void)receive(bus, Instant{} + rates::kTransmitTimeout);
  EXPECT_EQ(bus.state(), BusState::kUnconfirmed);
  EXPECT_TRUE(lost(bus.state()));
  EXPECT_EQ(bus.send(frames_of(2), Instant{} + milliseconds(22)), 0U) << "no second velocity behind the first";
  while (bus.counters().confirmed < kIds.size()) {
    (void)bus.wait_readable(milliseconds(100));
    (void)receive(bus, Instant{} + milliseconds(24));
  }
  EXPECT_EQ(bus.state(), BusState::kActive);
}

}  // namespace
}  // namespace ivo::hal
