#include "firmware/tools/bench/can/injector.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "config/base/contract.hpp"

namespace ivo::firmware::bench {
namespace {

can_frame frame_of(std::uint32_t id, std::initializer_list<std::uint8_t> data) noexcept {
  IVO_CONTRACT(data.size() <= CAN_MAX_DLEN);
  can_frame frame{};
  frame.can_id = id;
  frame.can_dlc = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), frame.data);
  return frame;
}

}  // namespace

Result<Injector> Injector::open(const std::string& interface) {
  hal::FileDescriptor socket(::socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  const int with_fd = 1;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
  if (!socket.valid() || address.can_ifindex == 0 ||
      setsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0) != 0 ||
      setsockopt(socket.get(), SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &with_fd, sizeof with_fd) != 0 ||
      bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return Error{"no raw socket on " + interface + ": " + std::strerror(errno)};
  }
  return Injector(std::move(socket));
}

void Injector::send(std::uint32_t id, std::initializer_list<std::uint8_t> data) const noexcept {
  const can_frame frame = frame_of(id, data);
  (void)!write(socket_.get(), &frame, sizeof frame);
}

void Injector::flood(int count, std::uint32_t id, std::initializer_list<std::uint8_t> data) const noexcept {
  for (int i = 0; i < count; ++i) {
    send(id, data);
  }
}

void Injector::send_remote(std::uint16_t id, std::uint8_t size) const noexcept {
  can_frame frame = frame_of(id | CAN_RTR_FLAG, {});
  frame.can_dlc = size;
  (void)!write(socket_.get(), &frame, sizeof frame);
}

void Injector::send_fd(std::uint16_t id, std::initializer_list<std::uint8_t> data) const noexcept {
  IVO_CONTRACT(data.size() <= CANFD_MAX_DLEN);
  canfd_frame frame{};
  frame.can_id = id;
  frame.len = static_cast<std::uint8_t>(data.size());
  frame.flags = CANFD_BRS;
  std::copy(data.begin(), data.end(), frame.data);
  (void)!write(socket_.get(), &frame, sizeof frame);
}

}  // namespace ivo::firmware::bench
