// What every CanBus promises (hal/api/can_bus.hpp), asked of each one that there is.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <vector>

#include "hal/linux/socketcan_bus.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::hal {
namespace {

struct VirtualPair {
  VirtualBus bus;
  CanBus& a = bus.port(0);
  CanBus& b = bus.port(1);
};

/// Two ends of an AF_UNIX pair, which carries whole can_frames where the kernel has no CAN.
struct SocketPair {
  static std::array<int, 2> make() {
    std::array<int, 2> fds{};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, fds.data()), 0);
    return fds;
  }
  std::array<int, 2> fds = make();
  SocketCanBus a{FileDescriptor(fds[0])};
  SocketCanBus b{FileDescriptor(fds[1])};
};

/// Two sockets on vcan0.
struct VcanPair {
  Result<SocketCanBus> first = SocketCanBus::open("vcan0");
  Result<SocketCanBus> second = SocketCanBus::open("vcan0");
  CanBus& a = first.value();
  CanBus& b = second.value();
};

template <class Pair>
bool available() {
  return true;
}
template <>
bool available<VcanPair>() {
  return std::getenv("IVO_OWN_NETWORK") != nullptr && SocketCanBus::open("vcan0").ok();
}

template <class Pair>
class CanBusContract : public testing::Test {
 protected:
  void SetUp() override {
    if (!available<Pair>()) {
      GTEST_SKIP() << "there is no vcan0 here";
    }
    pair_.emplace();
  }
  CanBus& a() { return pair_->a; }
  CanBus& b() { return pair_->b; }

 private:
  std::optional<Pair> pair_;
};

using Pairs = testing::Types<VirtualPair, SocketPair, VcanPair>;
TYPED_TEST_SUITE(CanBusContract, Pairs);

std::vector<CanFrame> numbered(std::size_t count) {
  std::vector<CanFrame> frames(count);
  for (std::size_t i = 0; i < count; ++i) {
    frames[i] = {.id = static_cast<std::uint16_t>(i % 0x800), .size = static_cast<std::uint8_t>(i % 9), .data = {}};
    for (std::size_t byte = 0; byte < frames[i].size; ++byte) {
      frames[i].data[byte] = static_cast<std::uint8_t>(i + byte);
    }
  }
  return frames;
}

std::vector<CanFrame> all_of(CanBus& bus) {
  std::vector<CanFrame> all;
  std::array<ReceivedFrame, 50> some;
  while (const std::size_t count = bus.receive(some, Instant{})) {
    for (std::size_t i = 0; i < count; ++i) {
      all.push_back(some[i].frame);
    }
  }
  return all;
}

TYPED_TEST(CanBusContract, DeliversFramesWholeAndInOrder) {
  const std::vector<CanFrame> frames = numbered(100);
  EXPECT_EQ(this->a().send(frames, Instant{}), frames.size());
  EXPECT_EQ(all_of(this->b()), frames);
}

TYPED_TEST(CanBusContract, CarriesEveryIdentifierAndEverySize) {
  const std::vector<CanFrame> frames = numbered(0x800);
  std::vector<CanFrame> arrived;
  for (std::size_t i = 0; i < frames.size(); i += 64) {
    EXPECT_EQ(this->a().send(std::span(frames).subspan(i, 64), Instant{}), 64U);
    EXPECT_TRUE(all_of(this->a()).empty());
    const std::vector<CanFrame> some = all_of(this->b());
    arrived.insert(arrived.end(), some.begin(), some.end());
  }
  EXPECT_EQ(arrived, frames);
}

TYPED_TEST(CanBusContract, TellsWhatTheLastSendHandedOver) {
  EXPECT_TRUE(this->a().handed_over().empty()) << "nothing yet";
  const std::vector<CanFrame> frames = numbered(5);
  EXPECT_EQ(this->a().send(frames, Instant{}), frames.size());
  const auto handed_over = this->a().handed_over();
  EXPECT_EQ(std::vector<CanFrame>(handed_over.begin(), handed_over.end()), frames);
  EXPECT_EQ(this->a().send({}, Instant{}), 0U);
  EXPECT_TRUE(this->a().handed_over().empty()) << "the last had nothing";
}

TYPED_TEST(CanBusContract, DoesNotHearItself) {
  this->a().send(numbered(3), Instant{});
  EXPECT_TRUE(all_of(this->a()).empty());
}

TYPED_TEST(CanBusContract, HandsOutWhatFitsAndKeepsTheRest) {
  const std::vector<CanFrame> frames = numbered(5);
  this->a().send(frames, Instant{});
  std::array<ReceivedFrame, 3> room;
  ASSERT_EQ(this->b().receive(room, Instant{}), 3U);
  EXPECT_EQ(room[2].frame, frames[2]);
  ASSERT_EQ(this->b().receive(room, Instant{}), 2U);
  EXPECT_EQ(room[1].frame, frames[4]);
  EXPECT_EQ(this->b().receive(room, Instant{}), 0U);
}

TYPED_TEST(CanBusContract, CountsWhatItSentAndReceived) {
  this->a().send(numbered(5), Instant{});
  all_of(this->b());
  EXPECT_EQ(this->a().counters().sent, 5U);
  EXPECT_EQ(this->a().counters().received, 0U);
  EXPECT_EQ(this->b().counters().received, 5U);
  EXPECT_EQ(this->b().counters().sent, 0U);
}

TYPED_TEST(CanBusContract, AcceptsEmptySpans) {
  EXPECT_EQ(this->a().send({}, Instant{}), 0U);
  this->b().send(numbered(1), Instant{});
  EXPECT_EQ(this->a().receive({}, Instant{}), 0U);
  EXPECT_EQ(all_of(this->a()).size(), 1U);
}

TYPED_TEST(CanBusContract, IsActiveFromTheStart) {
  EXPECT_EQ(this->a().state(), BusState::kActive);
  EXPECT_EQ(this->a().counters().send_dropped, 0U);
  EXPECT_EQ(this->a().counters().receive_dropped, 0U);
}

TYPED_TEST(CanBusContract, ConfirmsWhatHasLeftOnceItLooks) {
  this->a().send(numbered(5), Instant{});
  EXPECT_TRUE(all_of(this->a()).empty());
  EXPECT_EQ(this->a().counters().confirmed, 5U);
}

TYPED_TEST(CanBusContract, ArrivalsLieBetweenTheLastReceiveAndNow) {
  std::array<ReceivedFrame, 50> frames;
  Instant before{};
  this->b().receive(frames, before);
  for (int cycle = 1; cycle < 20; ++cycle) {
    const Instant now(std::chrono::milliseconds(2 * cycle));
    this->a().send(numbered(3), before);
    ASSERT_EQ(this->b().receive(frames, now), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GE(frames[i].at, before);
      EXPECT_LE(frames[i].at, now);
    }
    EXPECT_EQ(this->a().receive(frames, now), 0U);
    before = now;
  }
}

TYPED_TEST(CanBusContract, UnderAFloodKeepsTheOldestAndCountsTheRest) {
  const std::vector<CanFrame> frames = numbered(4000);
  for (std::size_t i = 0; i < frames.size(); i += 100) {
    this->a().send(std::span(frames).subspan(i, 100), Instant{});
    EXPECT_TRUE(all_of(this->a()).empty());
  }
  this->a().send({}, Instant(std::chrono::seconds(1)));  // what still waits is too old by now
  const BusCounters sent = this->a().counters();
  EXPECT_EQ(sent.sent + sent.send_dropped + sent.send_replaced, frames.size());
  std::vector<CanFrame> arrived = all_of(this->b());
  ASSERT_FALSE(arrived.empty());
  ASSERT_LT(arrived.size(), frames.size());
  EXPECT_TRUE(std::equal(arrived.begin(), arrived.begin() + 16, frames.begin()));

  // A socket tells its losses with the next frame that gets through.
  this->a().send(numbered(1), Instant(std::chrono::seconds(1)));
  all_of(this->b());
  EXPECT_EQ(this->b().counters().received + this->b().counters().receive_dropped, this->a().counters().sent);
}

}  // namespace
}  // namespace ivo::hal
