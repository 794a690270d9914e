// A watchdog of the machine, as /dev/watchdog: it resets the machine when it is not fed in time.
//
// For robots without a service manager that feeds it. Source: Linux, Documentation/watchdog/watchdog-api.rst.
#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "config/base/result.hpp"
#include "config/base/time.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::hal {

/// Runs from open() on. A process that dies, hangs or destroys this without end() leaves it running, and the machine is
/// reset: the robot is then as after a power cut. Any one thread at a time.
class WatchdogDevice {
 public:
  /// Starts the watchdog of `path` with a timeout of `timeout`, or what it makes of that. Errors: no such device, no
  /// right to it, another process has it, it is no watchdog, it cannot be that quick or that slow.
  [[nodiscard]] static Result<WatchdogDevice> open(const std::string& path, std::chrono::seconds timeout);

  /// A watchdog that runs already, with a timeout of `timeout`.
  WatchdogDevice(FileDescriptor device, Duration timeout) noexcept : device_(std::move(device)), timeout_(timeout) {}

  /// How long feed() may stay away.
  [[nodiscard]] Duration timeout() const noexcept { return timeout_; }
  /// One system call that does not wait. False: the device did not take it.
  bool feed() noexcept;
  /// Ends it in order: the machine is not reset. Afterwards it cannot be fed. False: the device did not take the word,
  /// and runs on. A kernel with CONFIG_WATCHDOG_NOWAYOUT lets no one end it.
  bool end() noexcept;

 private:
  FileDescriptor device_;
  Duration timeout_;
};

}  // namespace ivo::hal
