#include "hal/linux/service_notify.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace ivo::hal {
namespace {

std::optional<std::string> taken_out(const char* name) {
  const char* const value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): before there is another thread
  if (value == nullptr) {
    return std::nullopt;
  }
  std::string text = value;
  (void)unsetenv(name);  // NOLINT(concurrency-mt-unsafe)
  return text;
}

Result<std::uint64_t> number_in(const char* name, const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    return Error{std::string(name) + " is \"" + text + "\"; expected a whole number, as the service manager sets it"};
  }
  return number;
}

Result<std::optional<Duration>> timeout_of(const std::optional<std::string>& usec,
                                           const std::optional<std::string>& pid) {
  constexpr std::uint64_t kLongest = 1'000'000ULL * 86'400;  // a day; beyond, nobody watches
  if (pid) {
    const Result<std::uint64_t> number = number_in("WATCHDOG_PID", *pid);
    if (!number) {
      return number.error();
    }
    if (number.value() != static_cast<std::uint64_t>(getpid())) {
      return std::optional<Duration>{};  // another process is meant, as the one that started this one
    }
  }
  if (!usec) {
    return std::optional<Duration>{};
  }
  const Result<std::uint64_t> number = number_in("WATCHDOG_USEC", *usec);
  if (!number) {
    return number.error();
  }
  if (number.value() == 0 || number.value() > kLongest) {
    return std::optional<Duration>{};
  }
  return std::optional<Duration>(std::chrono::microseconds(number.value()));
}

}  // namespace

Result<ServiceNotify> ServiceNotify::open() {
  const std::optional<std::string> path = taken_out("NOTIFY_SOCKET");
  const std::optional<std::string> usec = taken_out("WATCHDOG_USEC");
  const std::optional<std::string> pid = taken_out("WATCHDOG_PID");
  if (!path) {
    return ServiceNotify();
  }
  if (path->size() < 2 || path->size() >= sizeof(sockaddr_un::sun_path) ||
      (path->front() != '/' && path->front() != '@')) {
    return Error{"NOTIFY_SOCKET is \"" + *path + "\"; expected the path of a socket, or @ and an abstract one's name"};
  }
  const Result<std::optional<Duration>> timeout = timeout_of(usec, pid);
  if (!timeout) {
    return timeout.error();
  }
  ServiceNotify notify;
  notify.socket_ = FileDescriptor(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!notify.socket_.valid()) {
    return Error{std::string("cannot open a socket to the service manager: ") + std::strerror(errno)};
  }
  notify.path_ = *path;
  if (notify.path_.front() == '@') {
    notify.path_.front() = '\0';
  }
  notify.timeout_ = timeout.value();
  notify.lost_ = std::make_unique<std::atomic<std::uint64_t>>(0);
  return notify;
}

void ServiceNotify::status(std::string_view text) {
  std::string message = "STATUS=" + std::string(text);
  // Behind a line break would come another assignment.
  std::replace_if(
      message.begin(), message.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  send(message);
}

// Not connected: a manager that starts anew is found again under the same name.
void ServiceNotify::send(std::string_view message) noexcept {
  if (!socket_.valid()) {
    return;
  }
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path_.data(), path_.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path_.size());
  const ssize_t sent = sendto(socket_.get(), message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                              reinterpret_cast<const sockaddr*>(&address), size);
  if (sent != static_cast<ssize_t>(message.size())) {
    lost_->fetch_add(1, std::memory_order_relaxed);
  }
}

}  // namespace ivo::hal
