// The wheel turner in a thread of its own, cycle by cycle in the world's time, and its ends towards the terminal's
// thread.
#pragma once

#include <atomic>
#include <thread>

#include "config/base/latest.hpp"
#include "config/base/spsc_ring.hpp"
#include "firmware/tools/wheels/wheel_turner.hpp"
#include "firmware/tools/wheels/wheels_world.hpp"

namespace ivo::firmware::wheels {

/// The loop never waits for the terminal: when that hangs no key arrives, and the wheel stops. One other thread.
class TurnLoop {
 public:
  /// Begins: the drives start up. `world` outlives this.
  explicit TurnLoop(World& world);
  /// Ends it and waits until the power is off or given up.
  ~TurnLoop();
  TurnLoop(const TurnLoop&) = delete;
  TurnLoop& operator=(const TurnLoop&) = delete;

  void give(const TurnOrder& order) noexcept { (void)orders_.push(order); }
  void hold_key() noexcept { hold_.store(true, std::memory_order_relaxed); }
  void other_key() noexcept { other_.store(true, std::memory_order_relaxed); }
  void end() noexcept { end_.store(true, std::memory_order_relaxed); }

  [[nodiscard]] const TurnStatus& status() noexcept { return status_.read(); }
  [[nodiscard]] bool running() const noexcept { return running_.load(std::memory_order_acquire); }

 private:
  void run() noexcept;

  World& world_;
  WheelTurner turner_;
  SpscRing<TurnOrder, 4> orders_;
  Latest<TurnStatus> status_;
  std::atomic<bool> hold_{false};
  std::atomic<bool> other_{false};
  std::atomic<bool> end_{false};
  std::atomic<bool> running_{true};
  std::thread thread_;
};

}  // namespace ivo::firmware::wheels
