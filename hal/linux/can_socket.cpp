#include "hal/linux/can_socket.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/net_tstamp.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace ivo::hal {
namespace {

static_assert(kFilterIds == CAN_RAW_FILTER_MAX);

constexpr int kPriority = 6;  // the first band of a pfifo_fast queue, without privileges

// Without the two flags in the mask, extended and remote frames with the same low bits pass too.
constexpr canid_t kPlainFrame = CAN_EFF_FLAG | CAN_RTR_FLAG;

Error refuse_socket(int error) {
  if (error == EAFNOSUPPORT || error == EPROTONOSUPPORT) {
    return Error{"this kernel has no CAN sockets (AF_CAN): load the can module or use the virtual bus"};
  }
  return Error{std::string("cannot open a CAN socket: ") + std::strerror(error)};
}

Result<int> find_interface(int socket, const std::string& name) {
  const Error unknown{"no CAN interface \"" + name + "\": `ip link show type can` (or vcan) lists those there are"};
  ifreq request{};
  if (name.empty() || name.size() >= sizeof request.ifr_name) {
    return unknown;
  }
  name.copy(request.ifr_name, name.size());
  if (ioctl(socket, SIOCGIFINDEX, &request) < 0) {
    return unknown;
  }
  const int index = request.ifr_ifindex;
  if (ioctl(socket, SIOCGIFHWADDR, &request) < 0 || request.ifr_hwaddr.sa_family != ARPHRD_CAN) {
    return Error{"\"" + name + "\" is not a CAN interface: `ip link show type can` (or vcan) lists those there are"};
  }
  if (ioctl(socket, SIOCGIFFLAGS, &request) < 0 || (request.ifr_flags & IFF_UP) == 0) {
    return Error{"CAN interface \"" + name + "\" is down: `ip link set " + name + " up` brings it up"};
  }
  return index;
}

std::vector<can_filter> filters_of(const std::vector<std::uint16_t>& ids) {
  if (ids.empty()) {
    return {{.can_id = 0, .can_mask = kPlainFrame}};
  }
  std::vector<can_filter> filters;
  filters.reserve(ids.size());
  for (const std::uint16_t id : ids) {
    filters.push_back({.can_id = id, .can_mask = CAN_SFF_MASK | kPlainFrame});
  }
  return filters;
}

template <class T>
bool set_option(int socket, int level, int option, const T& value) {
  return setsockopt(socket, level, option, &value, sizeof value) == 0;
}

bool set_up(int fd, int index, const CanSocketOptions& options) {
  const std::vector<can_filter> filters = filters_of(options.ids);
  const can_err_mask_t every_error = CAN_ERR_MASK;
  const int on = 1;
  const int hear_own = options.hear_own ? 1 : 0;
  const int stamps = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  set_option(fd, SOL_SOCKET, SO_PRIORITY, kPriority);
  if (!set_option(fd, SOL_SOCKET, SO_RCVBUFFORCE, options.receive_bytes)) {
    set_option(fd, SOL_SOCKET, SO_RCVBUF, options.receive_bytes);
  }
  return setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                    static_cast<socklen_t>(filters.size() * sizeof(can_filter))) == 0 &&
         set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, every_error) &&
         set_option(fd, SOL_CAN_RAW, CAN_RAW_LOOPBACK, on) &&
         set_option(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, hear_own) && set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, on) &&
         set_option(fd, SOL_SOCKET, SO_TIMESTAMPING, stamps) &&
         bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

}  // namespace

Result<CanSocket> open_can_socket(const std::string& name, const CanSocketOptions& options) {
  if (options.ids.size() > kFilterIds) {
    return Error{"CAN interface \"" + name + "\": " + std::to_string(options.ids.size()) +
                 " COB-IDs to hear; expected at most " + std::to_string(kFilterIds)};
  }
  for (const std::uint16_t id : options.ids) {
    if (id > CAN_SFF_MASK) {
      return Error{"CAN interface \"" + name + "\": COB-ID " + std::to_string(id) + " to hear; expected at most 2047"};
    }
  }
  FileDescriptor socket(::socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (!socket.valid()) {
    return refuse_socket(errno);
  }
  const Result<int> index = find_interface(socket.get(), name);
  if (!index) {
    return index.error();
  }
  if (!set_up(socket.get(), index.value(), options)) {
    return Error{"cannot set up CAN interface \"" + name + "\": " + std::strerror(errno)};
  }
  return CanSocket{std::move(socket), index.value()};
}

}  // namespace ivo::hal
