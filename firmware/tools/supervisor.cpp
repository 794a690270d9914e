#include "firmware/tools/supervisor.hpp"

#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <utility>

namespace ivo::firmware {
namespace {

constexpr Duration kTimeoutOfNobody = std::chrono::seconds(1);
constexpr Duration kQuickestLook = std::chrono::milliseconds(1);
constexpr int kLooksInTimeout = 4;  // one may come late and one get lost

}  // namespace

Supervisor::Supervisor(std::function<std::optional<std::uint64_t>()> loop_counter, hal::ServiceNotify notify,
                       std::optional<hal::WatchdogDevice> device)
    : loop_counter_(std::move(loop_counter)),
      notify_(std::move(notify)),
      device_(std::move(device)),
      seen_(loop_counter_().value_or(0)) {}

Supervisor::~Supervisor() { end_thread(); }

void Supervisor::start() {
  if (thread_.joinable() || (!notify_.listened_to() && !device_)) {
    return;
  }
  if (device_) {
    (void)device_->feed();  // it has waited since it was opened
  }
  end_ = hal::FileDescriptor(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  // A thread inherits the mask: a signal is for the thread that waits for it.
  sigset_t all{};
  sigset_t before{};
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_setname_np(thread_.native_handle(), "ivo-supervisor");
}

void Supervisor::stop() {
  end_thread();
  end_in_order();
}

void Supervisor::end_in_order() {
  if (std::exchange(ended_, true)) {
    return;
  }
  notify_.stopping();
  if (device_ && !device_->end()) {
    refused_feeds_.fetch_add(1, std::memory_order_relaxed);
  }
  device_.reset();
}

void Supervisor::look() {
  const std::optional<std::uint64_t> count = loop_counter_();
  if (!count) {
    return end_in_order();
  }
  if (std::exchange(seen_, *count) == *count || ended_) {
    return;
  }
  if (!std::exchange(ready_, true)) {
    notify_.ready();
  }
  notify_.alive();
  if (device_ && !device_->feed()) {
    refused_feeds_.fetch_add(1, std::memory_order_relaxed);
  }
}

Duration Supervisor::look_every() const noexcept {
  std::optional<Duration> shortest = notify_.timeout();
  if (device_) {
    shortest = std::min(shortest.value_or(device_->timeout()), device_->timeout());
  }
  return std::max(kQuickestLook, shortest.value_or(kTimeoutOfNobody) / kLooksInTimeout);
}

void Supervisor::run() {
  const sched_param ordinary{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  const auto wait_ms = static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(look_every()).count());
  pollfd end{.fd = end_.get(), .events = POLLIN, .revents = 0};
  // Without an eventfd, which a process may have run out of, the end is seen a look later.
  while (poll(&end, 1, wait_ms) <= 0 && !stopping_.load()) {
    look();
  }
}

void Supervisor::end_thread() {
  if (!thread_.joinable()) {
    return;
  }
  stopping_.store(true);
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(end_.get(), &one, sizeof one);
  thread_.join();
}

}  // namespace ivo::firmware
