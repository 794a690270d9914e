#include "hal/linux/interface_facts.hpp"

#include <gtest/gtest.h>
#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>

#include <cstring>
#include <string_view>
#include <vector>

namespace ivo::hal {
namespace {

using Bytes = std::vector<std::byte>;

template <class T>
Bytes bytes_of(const T& value) {
  Bytes bytes(sizeof value);
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

void append(Bytes& to, const Bytes& more) {
  to.insert(to.end(), more.begin(), more.end());
  to.resize((to.size() + 3) / 4 * 4);
}

Bytes attribute(int type, const Bytes& payload) {
  Bytes all = bytes_of(rtattr{.rta_len = static_cast<unsigned short>(sizeof(rtattr) + payload.size()),
                              .rta_type = static_cast<unsigned short>(type)});
  append(all, payload);
  return all;
}

Bytes text(std::string_view characters) {
  Bytes bytes(characters.size() + 1);
  std::memcpy(bytes.data(), characters.data(), characters.size());
  return bytes;
}

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts) {
    append(all, part);
  }
  return all;
}

struct Link {
  unsigned flags = IFF_UP;
  std::uint32_t bit_rate = 500'000;
  std::uint32_t state = CAN_STATE_ERROR_PASSIVE;
  std::string_view kind = "can";
};

/// As the kernel describes an interface with a controller.
Bytes link_message(const Link& link) {
  can_bittiming timing{};
  timing.bitrate = link.bit_rate;
  const Bytes data =
      joined({attribute(IFLA_CAN_BITTIMING, bytes_of(timing)), attribute(IFLA_CAN_STATE, bytes_of(link.state)),
              attribute(IFLA_CAN_RESTART_MS, bytes_of(std::uint32_t{100})),
              attribute(IFLA_CAN_BERR_COUNTER, bytes_of(can_berr_counter{.txerr = 130, .rxerr = 7}))});
  const Bytes info = joined({attribute(IFLA_INFO_KIND, text(link.kind)), attribute(IFLA_INFO_DATA, data)});
  ifinfomsg body{};
  body.ifi_type = ARPHRD_CAN;
  body.ifi_index = 5;
  body.ifi_flags = link.flags;
  const Bytes rest =
      joined({attribute(IFLA_IFNAME, text("can0")), attribute(IFLA_TXQLEN, bytes_of(std::uint32_t{10})),
              attribute(IFLA_MTU, bytes_of(std::uint32_t{16})), attribute(IFLA_LINKINFO | NLA_F_NESTED, info)});
  nlmsghdr head{};
  head.nlmsg_type = RTM_NEWLINK;
  head.nlmsg_len = static_cast<std::uint32_t>(sizeof head + sizeof body + rest.size());
  return joined({bytes_of(head), bytes_of(body), rest});
}

TEST(InterfaceFacts, SayWhatTheKernelSaysOfAController) {
  const auto facts = parse_link_message(link_message({}));
  ASSERT_TRUE(facts.has_value());
  EXPECT_EQ(facts->name, "can0");
  EXPECT_EQ(facts->index, 5);
  EXPECT_EQ(facts->kind, InterfaceFacts::Kind::kCan);
  EXPECT_TRUE(facts->carries_can);
  EXPECT_TRUE(facts->up);
  EXPECT_EQ(facts->bit_rate_bps, 500'000U);
  EXPECT_EQ(facts->restart_ms, 100U);
  EXPECT_EQ(facts->queue_frames, 10U);
  EXPECT_EQ(facts->mtu, 16U);
  EXPECT_EQ(facts->controller, BusState::kPassive);
  EXPECT_TRUE(facts->counts_errors);
  EXPECT_EQ(facts->transmit_errors, 130);
  EXPECT_EQ(facts->receive_errors, 7);
}

TEST(InterfaceFacts, KnowEachStateOfAController) {
  const auto state_of = [](std::uint32_t state) {
    return parse_link_message(link_message({.state = state}))->controller;
  };
  EXPECT_EQ(state_of(CAN_STATE_ERROR_ACTIVE), BusState::kActive);
  EXPECT_EQ(state_of(CAN_STATE_ERROR_WARNING), BusState::kWarning);
  EXPECT_EQ(state_of(CAN_STATE_BUS_OFF), BusState::kOff);
  EXPECT_EQ(state_of(CAN_STATE_STOPPED), std::nullopt);
  EXPECT_EQ(state_of(CAN_STATE_SLEEPING), std::nullopt);
}

TEST(InterfaceFacts, OfAnotherKindHaveNoBitRate) {
  const auto facts = parse_link_message(link_message({.flags = 0, .kind = "vcan"}));
  ASSERT_TRUE(facts.has_value());
  EXPECT_EQ(facts->kind, InterfaceFacts::Kind::kVcan);
  EXPECT_FALSE(facts->up);
  EXPECT_EQ(facts->bit_rate_bps, 0U);
  EXPECT_FALSE(facts->counts_errors);
}

TEST(InterfaceFacts, SurviveAMessageThatIsCutAnywhere) {
  const Bytes whole = link_message({});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(parse_link_message(cut), std::nullopt) << size << " bytes of a longer message";
    if (size >= sizeof(nlmsghdr)) {
      const auto length = static_cast<std::uint32_t>(size);
      std::memcpy(cut.data(), &length, sizeof length);
      (void)parse_link_message(cut);  // attributes that do not fit end it: the sanitizers look on
    }
  }
}

TEST(InterfaceFacts, RefuseAnotherBitRateThanTheRobotsAndSayHowToSetIt) {
  const InterfaceFacts facts = *parse_link_message(link_message({}));
  EXPECT_TRUE(check_bit_rate(facts, 500'000).ok());
  EXPECT_TRUE(check_bit_rate(facts, 0).ok());
  EXPECT_EQ(
      check_bit_rate(facts, 1'000'000).error().message,
      "CAN interface \"can0\" runs at 500000 bit/s; expected the robot's 1000000: `ip link set can0 down; ip link "
      "set can0 type can bitrate 1000000 restart-ms 100; ip link set can0 up`");
  EXPECT_TRUE(check_bit_rate(*parse_link_message(link_message({.kind = "vcan"})), 1'000'000).ok());
}

TEST(InterfaceFacts, AdviseAShortQueueAndARestartAfterBusOff) {
  InterfaceFacts facts = *parse_link_message(link_message({}));
  EXPECT_EQ(advice(facts), "");
  facts.queue_frames = 1000;
  EXPECT_EQ(advice(facts), "can0 queues 1000 frames, which cannot be called back: `ip link set can0 txqueuelen 32`");
  facts.restart_ms = 0;
  EXPECT_EQ(
      advice(facts),
      "can0 queues 1000 frames, which cannot be called back: `ip link set can0 txqueuelen 32`; it stays off after "
      "bus-off: `ip link set can0 down; ip link set can0 type can restart-ms 100; ip link set can0 up`");
  facts.kind = InterfaceFacts::Kind::kVcan;
  EXPECT_EQ(advice(facts), "");
}

TEST(InterfaceFacts, OfTheLoopbackAreAskedOfTheKernel) {
  const Result<InterfaceFacts> facts = interface_facts("lo");
  ASSERT_TRUE(facts.ok()) << facts.error().message;
  EXPECT_EQ(facts.value().name, "lo");
  EXPECT_FALSE(facts.value().carries_can);
  EXPECT_EQ(facts.value().kind, InterfaceFacts::Kind::kOther);
}

TEST(InterfaceFacts, OfNothingAreRefusedByName) {
  for (const char* name : {"can7", "", "a-name-that-no-interface-can-have"}) {
    EXPECT_EQ(interface_facts(name).error().message, std::string("no CAN interface \"") + name +
                                                         "\": `ip link show type can` (or vcan) lists those there are");
  }
}

}  // namespace
}  // namespace ivo::hal
