// What a service tells its service manager: that it is ready, how it is, that it lives, that it ends.
//
// The protocol of sd_notify(3): lines of NAME=value in one datagram to the socket that NOTIFY_SOCKET names.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::hal {

/// Each call is one system call that never waits, and may be made in any thread but the loop's. What the manager did
/// not take is counted, not repeated. Without a manager the calls do nothing.
class ServiceNotify {
 public:
  /// Nobody listens.
  ServiceNotify() = default;

  /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID and takes them out of the environment, so that no program
  /// started later speaks for this one: call it before there is another thread. Nobody listens where there is no
  /// NOTIFY_SOCKET. Errors: a socket that is neither a path nor abstract (`@name`), a timeout that is no number.
  [[nodiscard]] static Result<ServiceNotify> open();

  [[nodiscard]] bool listened_to() const noexcept { return socket_.valid(); }
  /// How long alive() may stay away before the manager ends this process; none: it does not watch.
  [[nodiscard]] std::optional<Duration> timeout() const noexcept { return timeout_; }

  void ready() noexcept { send("READY=1"); }
  void alive() noexcept { send("WATCHDOG=1"); }
  void stopping() noexcept { send("STOPPING=1"); }
  /// One line for a person, shown by `systemctl status`; line breaks become spaces.
  void status(std::string_view text);

  /// Messages that the manager did not take.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_ ? lost_->load(std::memory_order_relaxed) : 0; }

 private:
  void send(std::string_view message) noexcept;

  FileDescriptor socket_;
  std::string path_;  // of the manager's socket; an abstract one begins with a NUL
  std::optional<Duration> timeout_;
  std::unique_ptr<std::atomic<std::uint64_t>> lost_;
};

}  // namespace ivo::hal
