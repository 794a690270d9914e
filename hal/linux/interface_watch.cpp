#include "hal/linux/interface_watch.hpp"

#include <linux/rtnetlink.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <array>
#include <csignal>
#include <cstdint>

namespace ivo::hal {
namespace {

constexpr int kLookEveryMs = 200;

FileDescriptor changes_of_links() {
  FileDescriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, NETLINK_ROUTE));
  sockaddr_nl address{};
  address.nl_family = AF_NETLINK;
  address.nl_groups = RTMGRP_LINK;
  if (!socket.valid() || bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return {};
  }
  return socket;
}

// What changed is asked of the kernel; here counts only that something did, or that more did than the socket holds.
void read_all(int socket) {
  std::array<char, 8192> message{};
  while (recv(socket, message.data(), message.size(), MSG_DONTWAIT) > 0) {
  }
}

}  // namespace

InterfaceWatch::InterfaceWatch(SocketCanBus& bus)
    : bus_(bus), changes_(changes_of_links()), end_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  // A thread inherits the mask: a signal is for the thread that waits for it.
  sigset_t all{};
  sigset_t before{};
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

InterfaceWatch::~InterfaceWatch() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(end_.get(), &one, sizeof one);
  thread_.join();
}

void InterfaceWatch::run() {
  const sched_param ordinary{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  std::array<pollfd, 2> news{
      {{.fd = end_.get(), .events = POLLIN, .revents = 0}, {.fd = changes_.get(), .events = POLLIN, .revents = 0}}};
  for (;;) {
    bus_.look_at_interface();
    (void)poll(news.data(), news.size(), kLookEveryMs);
    if (news[0].revents != 0) {
      return;
    }
    if (news[1].revents != 0) {
      read_all(changes_.get());
    }
  }
}

}  // namespace ivo::hal
