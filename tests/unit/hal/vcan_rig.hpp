// A vcan interface of a test's own, and a raw socket on it that says what it likes. Only where toolchain/vcan gave the
// test a network of its own: elsewhere it would change the host's.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "hal/api/file_descriptor.hpp"
#include "hal/linux/socketcan_bus.hpp"

namespace ivo::hal {

inline bool shell(const std::string& command) {
  // Tests have one thread here and no locale to lose.
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;  // NOLINT(concurrency-mt-unsafe)
}

/// A kernel may deliver a frame a little after the call that sent it, but it delivers them in order: when one that is
/// sent now is back, all are that this thread sent before, on whatever interface.
inline void let_arrive() {
  const FileDescriptor socket(::socket(AF_CAN, SOCK_RAW, CAN_RAW));
  const int on = 1;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex("vcan0"));
  can_frame frame{};
  frame.can_id = 0x7FE;
  ASSERT_EQ(setsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, &on, sizeof on), 0);
  ASSERT_EQ(bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(write(socket.get(), &frame, sizeof frame), static_cast<ssize_t>(sizeof frame));
  ASSERT_EQ(read(socket.get(), &frame, sizeof frame), static_cast<ssize_t>(sizeof frame));
}

inline can_frame raw_frame(canid_t id, std::uint8_t value = 0) {
  can_frame frame{};
  frame.can_id = id;
  frame.can_dlc = 8;
  frame.data[0] = value;
  return frame;
}

/// Another program on this host.
class Stranger {
 public:
  explicit Stranger(const std::string& name) : socket_(socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK, CAN_RAW)) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex(name.c_str()));
    EXPECT_EQ(bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  bool put(const can_frame& frame) const { return write(socket_.get(), &frame, sizeof frame) == sizeof frame; }
  bool put(canid_t id, std::uint8_t value = 0) const { return put(raw_frame(id, value)); }
  [[nodiscard]] std::vector<can_frame> heard() const {
    let_arrive();
    std::vector<can_frame> all;
    can_frame frame{};
    while (read(socket_.get(), &frame, sizeof frame) == sizeof frame) {
      all.push_back(frame);
    }
    return all;
  }
  [[nodiscard]] int get() const { return socket_.get(); }

 private:
  FileDescriptor socket_;
};

class OnVcan : public testing::Test {
 protected:
  static constexpr const char* kLink = "vcan7";

  static void add_link() { ASSERT_TRUE(shell("ip link add dev vcan7 type vcan && ip link set vcan7 up")); }
  static void remove_link() { ASSERT_TRUE(shell("ip link del vcan7")); }

  void SetUp() override {
    if (std::getenv("IVO_OWN_NETWORK") == nullptr) {
      GTEST_SKIP() << "needs a network of its own: toolchain/vcan";
    }
    // Frames keep their order on one processor.
    cpu_set_t here;
    CPU_ZERO(&here);
    CPU_SET(static_cast<std::size_t>(sched_getcpu()), &here);
    ASSERT_EQ(sched_setaffinity(0, sizeof here, &here), 0);
    add_link();
  }
  void TearDown() override {
    if (!IsSkipped()) {
      (void)shell("ip link del vcan7");
    }
  }

  /// What `bus` receives now.
  std::vector<ReceivedFrame> receive(SocketCanBus& bus, Instant now = {}) {
    let_arrive();
    std::array<ReceivedFrame, 64> some;
    std::vector<ReceivedFrame> all;
    while (const std::size_t count = bus.receive(some, now)) {
      all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return all;
  }
  std::vector<std::uint16_t> ids(SocketCanBus& bus) {
    std::vector<std::uint16_t> all;
    for (const ReceivedFrame& frame : receive(bus)) {
      all.push_back(frame.frame.id);
    }
    return all;
  }
};

}  // namespace ivo::hal
