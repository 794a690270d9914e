// Whose connection is it? All that counts by address counts by this.
#pragma once

#include <sys/socket.h>

#include <string>

namespace ivo::firmware::web {

struct ClientAddress {
  /// "192.0.2.7"; of IPv6 the network, "2001:db8:0:1::/64", as one machine has all of its addresses. Empty: unknown.
  std::string group;
  bool this_machine = false;  ///< over loopback
};

/// Ports and scopes count for nothing; an IPv4 address within IPv6 is the IPv4 address.
[[nodiscard]] ClientAddress client_address(const sockaddr_storage& peer);
/// Of a connected socket; unknown when it is gone.
[[nodiscard]] ClientAddress client_address(int socket);

}  // namespace ivo::firmware::web
