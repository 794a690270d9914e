#include "firmware/web/client_address.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ivo::firmware::web {
namespace {

template <class Address>
Address as(const sockaddr_storage& peer) {
  Address address{};
  std::memcpy(&address, &peer, sizeof(address));
  return address;
}

std::string address_text(int family, const void* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  return ::inet_ntop(family, address, text.data(), text.size()) != nullptr ? text.data() : "";
}

ClientAddress of_four(const in_addr& address) {
  constexpr std::uint32_t kLoopbackNet = 127;
  return {.group = address_text(AF_INET, &address), .this_machine = ntohl(address.s_addr) >> 24U == kLoopbackNet};
}

}  // namespace

ClientAddress client_address(const sockaddr_storage& peer) {
  if (peer.ss_family == AF_INET) {
    return of_four(as<sockaddr_in>(peer).sin_addr);
  }
  if (peer.ss_family != AF_INET6) {
    return {};
  }
  in6_addr six = as<sockaddr_in6>(peer).sin6_addr;
  if (IN6_IS_ADDR_V4MAPPED(&six) != 0) {
    constexpr std::size_t kFourWithinSix = 12;
    in_addr four{};
    std::memcpy(&four, static_cast<const std::uint8_t*>(six.s6_addr) + kFourWithinSix, sizeof(four));
    return of_four(four);
  }
  if (IN6_IS_ADDR_LOOPBACK(&six) != 0) {
    return {.group = "::1", .this_machine = true};
  }
  constexpr std::size_t kNetworkBytes = 8;
  std::fill(std::begin(six.s6_addr) + kNetworkBytes, std::end(six.s6_addr), std::uint8_t{0});
  return {.group = address_text(AF_INET6, &six) + "/64", .this_machine = false};
}

ClientAddress client_address(int socket) {
  sockaddr_storage peer{};
  socklen_t size = sizeof(peer);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): how the system calls want it
  const bool known = ::getpeername(socket, reinterpret_cast<sockaddr*>(&peer), &size) == 0;
  return known ? client_address(peer) : ClientAddress{};
}

}  // namespace ivo::firmware::web
