// The loop in its time: cycles at their deadlines, in the caller's thread where time waits for it, else in one of its
// own that nothing else in the program is as urgent as.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "firmware/loop/control_loop.hpp"
#include "firmware/loop/overrun_policy.hpp"
#include "firmware/tools/run_world.hpp"
#include "hal/linux/real_time.hpp"

namespace ivo::firmware {

class LoopRunner {
 public:
  /// `place`: the thread's priority and CPU; none: ordinary scheduling. All that is referred to outlives this.
  LoopRunner(ControlLoop& loop, RunWorld& world, Duration period, std::optional<hal::RealTimePlace> place);

  /// Until the loop has finished. `observe(wait_ms)` is called between cycles where time waits, else beside them again
  /// and again; when it throws there, the loop goes on until the robot stands, and then this throws on.
  void run(const std::function<void(int wait_ms)>& observe);

  /// The loop has made its last cycle. Any thread.
  [[nodiscard]] bool ended() const noexcept { return ended_.load(); }
  /// Page faults of the loop's thread between its first cycle and its last; once run() has returned.
  [[nodiscard]] const hal::PageFaults& page_faults() const noexcept { return page_faults_; }

 private:
  bool one_cycle();
  void run_in_this_thread(const std::function<void(int wait_ms)>& observe);
  void run_beside(const std::function<void(int wait_ms)>& observe);
  void cycles();

  ControlLoop& loop_;
  RunWorld& world_;
  Duration period_;
  std::optional<hal::RealTimePlace> place_;
  Scheduler scheduler_;
  std::int64_t skipped_ = 0;
  hal::PageFaults page_faults_;
  std::atomic<bool> ended_{false};
};

}  // namespace ivo::firmware
