// Watches the loop from a thread of its own, and vouches for it to who watches us: the service manager, the machine's
// watchdog, or both.
//
// The chain: the loop counts its cycles; this looks at the count and speaks only when it has moved; the manager ends a
// process that does not speak, and the machine's watchdog resets a machine on which nobody feeds it. A loop that hangs
// is not vouched for by a thread that still runs. The drives watch the loop themselves, by its heartbeat.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <thread>

#include "config/base/time.hpp"
#include "hal/api/file_descriptor.hpp"
#include "hal/linux/service_notify.hpp"
#include "hal/linux/watchdog_device.hpp"

namespace ivo::firmware {

class Supervisor {
 public:
  /// `loop_counter` says how many cycles the loop has made, nothing once it has ended in order; it is called in this
  /// object's thread while the loop runs, so it reads atomics.
  Supervisor(std::function<std::optional<std::uint64_t>()> loop_counter, hal::ServiceNotify notify,
             std::optional<hal::WatchdogDevice> device = std::nullopt);
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  /// Without stop() before, an end that nobody ordered: the machine's watchdog runs on.
  ~Supervisor();

  /// Before or as the loop starts. The thread takes no signals and keeps an ordinary one's scheduling, whatever its
  /// creator's; there is none where nobody listens and there is no device.
  void start();
  /// Once the loop has ended in order and the robot stands: says so, and ends the machine's watchdog in order.
  void stop();

  /// One look, as the thread takes every look_every(). The first time that the count has moved it says that the service
  /// is ready; that time and each later one it vouches for the loop. A loop that has ended in order is what stop() is:
  /// who writes the results may take their time.
  void look();
  /// A quarter of the shortest timeout of those who watch us, a quarter of a second where none of them has one.
  [[nodiscard]] Duration look_every() const noexcept;

  /// One line for who asks how the service is. Any thread but the loop's.
  void say(std::string_view status) { notify_.status(status); }

  /// What those who watch us did not take. Any thread.
  [[nodiscard]] std::uint64_t lost() const noexcept {
    return notify_.lost() + refused_feeds_.load(std::memory_order_relaxed);
  }

 private:
  void run();
  void end_thread();
  void end_in_order();

  std::function<std::optional<std::uint64_t>()> loop_counter_;
  hal::ServiceNotify notify_;
  std::optional<hal::WatchdogDevice> device_;
  std::uint64_t seen_ = 0;
  bool ready_ = false;
  bool ended_ = false;
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint64_t> refused_feeds_{0};
  hal::FileDescriptor end_;
  std::thread thread_;
};

}  // namespace ivo::firmware
