#include "firmware/tools/bench/can/delivery.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace ivo::firmware::bench {
namespace {

constexpr canid_t kMark = CAN_EFF_MASK | CAN_EFF_FLAG;  // the lowest priority there is
constexpr int kPatienceMs = 1000;

hal::FileDescriptor bound_socket(int interface, const can_filter* filter, socklen_t size) noexcept {
  hal::FileDescriptor socket(::socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = interface;
  if (socket.valid() && setsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_FILTER, filter, size) == 0 &&
      bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return socket;
  }
  return {};
}

}  // namespace

Result<Delivery> Delivery::open(const std::string& interface) {
  const can_filter only_mark{.can_id = kMark, .can_mask = CAN_EFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG};
  const int index = static_cast<int>(if_nametoindex(interface.c_str()));
  hal::FileDescriptor sender = bound_socket(index, nullptr, 0);
  hal::FileDescriptor hearer = bound_socket(index, &only_mark, sizeof only_mark);
  if (index == 0 || !sender.valid() || !hearer.valid()) {
    return Error{"no raw socket on " + interface + ": " + std::strerror(errno)};
  }
  return Delivery(std::move(sender), std::move(hearer));
}

void Delivery::wait() const noexcept {
  can_frame mark{};
  mark.can_id = kMark;
  if (write(sender_.get(), &mark, sizeof mark) != sizeof mark) {
    return;
  }
  pollfd arrived{.fd = hearer_.get(), .events = POLLIN, .revents = 0};
  while (read(hearer_.get(), &mark, sizeof mark) != sizeof mark) {
    if (poll(&arrived, 1, kPatienceMs) <= 0) {
      return;
    }
  }
}

void stay_on_one_cpu() noexcept {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(sched_getcpu()), &one);
  (void)sched_setaffinity(0, sizeof one, &one);
}

}  // namespace ivo::firmware::bench
