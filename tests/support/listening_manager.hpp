// A service manager that only listens: a datagram socket, and the variables that tell a service of it.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "hal/api/file_descriptor.hpp"

namespace ivo {

class ListeningManager {
 public:
  /// `name` as NOTIFY_SOCKET has it: a path that is not there yet, or @ and a name.
  explicit ListeningManager(const std::string& name)
      : name_(name), socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof address.sun_path - 1);
    if (name.front() == '@') {
      address.sun_path[0] = '\0';
    }
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    EXPECT_EQ(bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), size), 0) << name;
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  ListeningManager(const ListeningManager&) = delete;
  ListeningManager& operator=(const ListeningManager&) = delete;
  ~ListeningManager() {
    forget();
    if (name_.front() == '/') {
      unlink(name_.c_str());
    }
  }

  /// An abstract name that no other test program has.
  static std::string some_name() { return "@ivo-test-" + std::to_string(getpid()); }

  static void watch(const std::string& usec) { setenv("WATCHDOG_USEC", usec.c_str(), 1); }
  static void watch(const std::string& usec, const std::string& pid) {
    watch(usec);
    setenv("WATCHDOG_PID", pid.c_str(), 1);
  }
  static void forget() {
    for (const char* const name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) {
      unsetenv(name);
    }
  }

  /// What has come since the last call, a message an entry.
  std::vector<std::string> heard() {
    std::vector<std::string> messages;
    std::array<char, 512> message{};
    for (ssize_t size = 0; (size = recv(socket_.get(), message.data(), message.size(), MSG_DONTWAIT)) >= 0;) {
      messages.emplace_back(message.data(), static_cast<std::size_t>(size));
    }
    return messages;
  }
  /// Waits for one.
  std::string next() {
    std::array<char, 512> message{};
    const ssize_t size = recv(socket_.get(), message.data(), message.size(), 0);
    return size < 0 ? std::string() : std::string(message.data(), static_cast<std::size_t>(size));
  }

 private:
  std::string name_;
  hal::FileDescriptor socket_;
};

}  // namespace ivo
