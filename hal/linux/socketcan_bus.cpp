#include "hal/linux/socketcan_bus.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "config/base/contract.hpp"
#include "config/limits.hpp"
#include "hal/linux/error_frame.hpp"

namespace ivo::hal {
namespace {

constexpr int kReceiveBufferBytes = 1 << 20;  // about 1,300 frames: 150 ms of a saturated 1 Mbit/s bus

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

template <class T>
bool set_option(int socket, int level, int option, const T& value) {
  return setsockopt(socket, level, option, &value, sizeof value) == 0;
}

}  // namespace

struct SocketCanBus::Messages {
  static constexpr std::size_t kCount = limits::kFramesPerCycle;
  struct alignas(cmsghdr) Control {
    std::array<char, CMSG_SPACE(sizeof(std::uint32_t))> bytes;
  };

  std::array<can_frame, kCount> frames{};
  std::array<iovec, kCount> places{};
  std::array<Control, kCount> controls{};
  std::array<mmsghdr, kCount> headers{};
  std::uint32_t lost_so_far = 0;

  Messages() noexcept {
    for (std::size_t i = 0; i < kCount; ++i) {
      places[i] = {.iov_base = &frames[i], .iov_len = sizeof(can_frame)};
      headers[i].msg_hdr.msg_iov = &places[i];
      headers[i].msg_hdr.msg_iovlen = 1;
    }
  }

  void ready_to_receive(std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      headers[i].msg_hdr.msg_control = controls[i].bytes.data();
      headers[i].msg_hdr.msg_controllen = sizeof(Control);
    }
  }

  void ready_to_send(std::span<const CanFrame> from) noexcept {
    for (std::size_t i = 0; i < from.size(); ++i) {
      IVO_CONTRACT(from[i].id <= CAN_SFF_MASK && from[i].size <= CAN_MAX_DLEN);
      frames[i] = {};
      frames[i].can_id = from[i].id;
      frames[i].can_dlc = from[i].size;
      std::copy(from[i].data.begin(), from[i].data.end(), frames[i].data);
      headers[i].msg_hdr.msg_control = nullptr;
      headers[i].msg_hdr.msg_controllen = 0;
    }
  }

  /// Frames that the socket lost since the last call, as far as message `i` tells.
  std::uint32_t newly_lost(std::size_t i) noexcept {
    msghdr& header = headers[i].msg_hdr;
    for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
      if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t lost = 0;
        std::memcpy(&lost, CMSG_DATA(c), sizeof lost);
        const std::uint32_t more = lost - lost_so_far;
        lost_so_far = lost;
        return more;
      }
    }
    return 0;
  }
};

Result<SocketCanBus> SocketCanBus::open(const std::string& name) {
  FileDescriptor socket(::socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  if (!socket.valid()) {
    return refuse_socket(errno);
  }
  const int fd = socket.get();
  const Result<int> index = find_interface(fd, name);
  if (!index.ok()) {
    return index.error();
  }
  // Without the two flags in the mask, extended and remote frames with the same low bits pass too.
  const can_filter plain_data_frames{.can_id = 0, .can_mask = CAN_EFF_FLAG | CAN_RTR_FLAG};
  const can_err_mask_t every_error = CAN_ERR_MASK;
  const int on = 1;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index.value();
  if (!set_option(fd, SOL_CAN_RAW, CAN_RAW_FILTER, plain_data_frames) ||
      !set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, every_error) || !set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, on) ||
      bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) < 0) {
    return Error{"cannot set up CAN interface \"" + name + "\": " + std::strerror(errno)};
  }
  if (!set_option(fd, SOL_SOCKET, SO_RCVBUFFORCE, kReceiveBufferBytes)) {
    set_option(fd, SOL_SOCKET, SO_RCVBUF, kReceiveBufferBytes);
  }
  return SocketCanBus(std::move(socket));
}

SocketCanBus::SocketCanBus(FileDescriptor socket)
    : socket_(std::move(socket)), messages_(std::make_unique<Messages>()) {}
SocketCanBus::SocketCanBus(SocketCanBus&&) noexcept = default;
SocketCanBus& SocketCanBus::operator=(SocketCanBus&&) noexcept = default;
SocketCanBus::~SocketCanBus() = default;

std::size_t SocketCanBus::receive(std::span<ReceivedFrame> frames, Instant now) noexcept {
  const std::size_t room = std::min(frames.size(), Messages::kCount);
  messages_->ready_to_receive(room);
  const int got =
      recvmmsg(socket_.get(), messages_->headers.data(), static_cast<unsigned>(room), MSG_DONTWAIT, nullptr);
  if (got < 0) {
    note_error(errno);
    return 0;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(got); ++i) {
    counters_.receive_dropped += messages_->newly_lost(i);
    const can_frame& raw = messages_->frames[i];
    if (messages_->headers[i].msg_len != sizeof(can_frame) || raw.can_dlc > CAN_MAX_DLEN) {
      continue;
    }
    if ((raw.can_id & CAN_ERR_FLAG) != 0) {
      state_ = state_told_by(raw).value_or(state_);
      continue;
    }
    if ((raw.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) != 0) {
      continue;
    }
    frames[count].at = now;
    CanFrame& frame = frames[count++].frame;
    frame.id = static_cast<std::uint16_t>(raw.can_id & CAN_SFF_MASK);
    frame.size = raw.can_dlc;
    std::copy_n(raw.data, frame.data.size(), frame.data.begin());
  }
  if (count > 0) {
    note_interface_works();
  }
  counters_.received += count;
  return count;
}

std::size_t SocketCanBus::send(std::span<const CanFrame> frames, Instant /*now*/) noexcept {
  const std::span<const CanFrame> batch = frames.first(std::min(frames.size(), Messages::kCount));
  messages_->ready_to_send(batch);
  const int took = sendmmsg(socket_.get(), messages_->headers.data(), static_cast<unsigned>(batch.size()),
                            MSG_DONTWAIT | MSG_NOSIGNAL);
  if (took < 0) {
    note_error(errno);
  } else if (took > 0) {
    note_interface_works();
  }
  const auto count = static_cast<std::size_t>(std::max(took, 0));
  counters_.sent += count;
  counters_.send_dropped += frames.size() - count;
  return count;
}

bool SocketCanBus::wait_readable(Duration limit) const noexcept {
  const Duration wait = std::max(limit, Duration::zero());
  const timespec timeout{.tv_sec = wait.count() / 1'000'000'000, .tv_nsec = wait.count() % 1'000'000'000};
  pollfd ready{.fd = socket_.get(), .events = POLLIN, .revents = 0};
  return ppoll(&ready, 1, &timeout, nullptr) > 0;
}

void SocketCanBus::note_error(int error) noexcept {
  if (error == ENODEV || error == ENXIO) {
    state_ = BusState::kRemoved;
  } else if (error == ENETDOWN && state_ != BusState::kRemoved) {
    state_ = BusState::kDown;
  }
}

void SocketCanBus::note_interface_works() noexcept {
  if (state_ == BusState::kDown) {
    state_ = BusState::kActive;
  }
}

}  // namespace ivo::hal
