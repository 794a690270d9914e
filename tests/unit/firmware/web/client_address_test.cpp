#include "firmware/web/client_address.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

#include <cstring>

#include "firmware/web/connection_limits.hpp"

namespace ivo::firmware::web {
namespace {

ClientAddress peer_at(const char* text) {
  sockaddr_storage peer{};
  sockaddr_in four{};
  sockaddr_in6 six{};
  if (::inet_pton(AF_INET, text, &four.sin_addr) == 1) {
    four.sin_family = AF_INET;
    four.sin_port = 7;
    std::memcpy(&peer, &four, sizeof(four));
  } else if (::inet_pton(AF_INET6, text, &six.sin6_addr) == 1) {
    six.sin6_family = AF_INET6;
    six.sin6_scope_id = 3;
    std::memcpy(&peer, &six, sizeof(six));
  }
  return client_address(peer);
}

TEST(ClientAddress, IsTheAddressOrItsNetwork) {
  EXPECT_EQ(peer_at("192.0.2.7").group, "192.0.2.7");
  EXPECT_EQ(peer_at("::ffff:192.0.2.7").group, "192.0.2.7");
  EXPECT_EQ(peer_at("2001:db8:1:2:3:4:5:6").group, "2001:db8:1:2::/64");
  EXPECT_EQ(peer_at("2001:db8:1:2::9").group, "2001:db8:1:2::/64");
  EXPECT_EQ(peer_at("fe80::1").group, "fe80::/64");
  EXPECT_EQ(peer_at("none").group, "");
  EXPECT_EQ(client_address(-1).group, "");
}

TEST(ClientAddress, KnowsThisMachine) {
  for (const char* address : {"127.0.0.1", "127.9.9.9", "::1", "::ffff:127.0.0.1"}) {
    EXPECT_TRUE(peer_at(address).this_machine) << address;
  }
  for (const char* address : {"128.0.0.1", "1.0.0.127", "::2", "::ffff:192.0.2.7", "none"}) {
    EXPECT_FALSE(peer_at(address).this_machine) << address;
  }
}

TEST(ConnectionLimits, KeepsPlacesForThisMachine) {
  ConnectionLimits limits;
  int opened = 0;
  for (int i = 0; i < 100; ++i) {
    const ClientAddress one{.group = std::to_string(i), .this_machine = false};
    if (limits.allows(one)) {
      limits.opened(one);
      ++opened;
    }
  }
  EXPECT_EQ(opened, ConnectionLimits::kMost - ConnectionLimits::kOfThisMachine);
  const ClientAddress here = peer_at("::1");
  for (int i = 0; i < ConnectionLimits::kOfThisMachine; ++i) {
    EXPECT_TRUE(limits.allows(here));
    limits.opened(here);
  }
  EXPECT_FALSE(limits.allows(here));
  limits.closed({.group = "3", .this_machine = false});
  EXPECT_TRUE(limits.allows(here));
  EXPECT_TRUE(limits.allows({.group = "new", .this_machine = false}));
}

TEST(ConnectionLimits, CountsByNetwork) {
  ConnectionLimits limits;
  for (int i = 0; i < ConnectionLimits::kMostOfOne; ++i) {
    limits.opened(peer_at("2001:db8::1"));
  }
  EXPECT_FALSE(limits.allows(peer_at("2001:db8::2")));
  EXPECT_TRUE(limits.allows(peer_at("2001:db8:0:1::2")));
}

}  // namespace
}  // namespace ivo::firmware::web
