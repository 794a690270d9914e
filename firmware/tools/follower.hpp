// A thread that does one thing again and again, beside a loop that waits for nobody.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include "hal/linux/real_time.hpp"

namespace ivo::firmware {

class Follower {
 public:
  Follower() = default;
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  ~Follower() { stop(); }

  /// `name`: of the thread, for who looks at the machine. `step` may throw: it is not called any more then.
  void start(const char* name, std::chrono::milliseconds every, std::function<void()> step) {
    running_.store(true);
    thread_ = std::thread([this, name, every, step = std::move(step)] {
      hal::name_thread(name);
      try {
        while (running_.load(std::memory_order_relaxed)) {
          step();
          std::this_thread::sleep_for(every);
        }
      } catch (...) {  // out of memory, say: the loop goes on, and what is not done is counted by whoever waits for it
      }
    });
  }
  void stop() {
    running_.store(false);
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  [[nodiscard]] bool running() const noexcept { return running_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> running_{false};
  std::thread thread_;
};

}  // namespace ivo::firmware
