// GPIO lines that a test drives, for a thread that reads them.
#pragma once

#include <pthread.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "hal/api/clock.hpp"
#include "hal/linux/gpio_lines.hpp"

namespace ivo::hal {

/// A clock that both threads may read: it moves when the test says so.
class SharedClock final : public Clock {
 public:
  Instant now() noexcept override { return now_.load(); }
  void sleep_until(Instant deadline) noexcept override { now_.store(deadline); }

 private:
  std::atomic<Instant> now_{Instant(std::chrono::seconds(1))};
};

/// What a test and the lines, which belong to the thread, share. Each change waits until the thread has seen it
/// through, so that no test depends on time.
class LineScript {
 public:
  void set(std::uint8_t pressed) {
    change([&] { pressed_ = pressed; });
  }
  /// Pressed and released between two readings: the edge is all there is to see of it.
  void tap(std::uint8_t inputs) {
    change([&] { edges_ = inputs; });
  }
  void make_unreadable(bool unreadable) {
    change([&] { unreadable_ = unreadable; });
  }
  void make_unreadable_before_the_first() { unreadable_ = true; }
  /// Whether the thread that reads has this signal blocked.
  [[nodiscard]] bool reader_blocks(int signal) {
    const std::lock_guard lock(mutex_);
    return sigismember(&reader_mask_, signal) == 1;
  }
  /// The thread comes to a stop in its next reading, as one that gets no processor.
  void hang() {
    std::unique_lock lock(mutex_);
    hanging_ = true;
    changed_.notify_all();
    changed_.wait(lock, [&] { return hung_; });
  }
  void go_on() {
    std::unique_lock lock(mutex_);
    hanging_ = hung_ = false;
    changed_.notify_all();
    await_round(lock);
  }
  /// The lines have been read and handed over at least once from now on.
  void await_reading() {
    change([] {});
  }

 private:
  friend class ScriptedLines;
  template <class Change>
  void change(const Change& what) {
    std::unique_lock lock(mutex_);
    what();
    changed_.notify_all();
    await_round(lock);
  }
  // Two waits later the reading between them is handed over.
  void await_round(std::unique_lock<std::mutex>& lock) {
    const int enough = waits_ + 2;
    changed_.wait(lock, [&] { return waits_ >= enough; });
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint8_t pressed_ = 0;
  std::uint8_t edges_ = 0;
  bool unreadable_ = false;
  bool hanging_ = false;
  bool hung_ = false;
  int waits_ = 0;
  sigset_t reader_mask_{};
};

class ScriptedLines final : public GpioLines {
 public:
  explicit ScriptedLines(LineScript& script) : script_(script) {}
  std::uint8_t wait(Duration /*limit*/) noexcept override {
    const std::lock_guard lock(script_.mutex_);
    ++script_.waits_;
    script_.changed_.notify_all();
    return std::exchange(script_.edges_, std::uint8_t{0});
  }
  std::optional<std::uint8_t> read() noexcept override {
    std::unique_lock lock(script_.mutex_);
    pthread_sigmask(SIG_SETMASK, nullptr, &script_.reader_mask_);
    while (script_.hanging_) {
      script_.hung_ = true;
      script_.changed_.notify_all();
      script_.changed_.wait(lock);
    }
    return script_.unreadable_ ? std::nullopt : std::optional(script_.pressed_);
  }

 private:
  LineScript& script_;
};

}  // namespace ivo::hal
