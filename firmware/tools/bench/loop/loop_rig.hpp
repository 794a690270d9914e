// The whole loop with the virtual bus and four simulated drives, for measuring: its cycles run one right after the
// other, and only what the loop itself does is timed.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "drivers/sim/sim_drives.hpp"
#include "firmware/loop/control_loop.hpp"
#include "firmware/record/traced_bus.hpp"
#include "firmware/record/tracer.hpp"
#include "firmware/tools/bench/scenes.hpp"
#include "hal/linux/monotonic_clock.hpp"
#include "hal/sim/virtual_bus.hpp"

namespace ivo::firmware::bench {

/// What one cycle cost, in us on the stopwatch.
struct CycleCost {
  double whole_us = 0.0;
  std::array<double, kPhases> phases_us{};
  double planner_units = 0.0;
};

/// The planner is the program's: one rig at a time. Simulated time, by which the loop acts, is not the stopwatch's.
class LoopRig {
 public:
  /// `generations`: how long it plans. The drives start up at once.
  explicit LoopRig(int generations);

  /// The planner takes open ground; else nothing else may be called.
  [[nodiscard]] bool ready() const noexcept { return loop_ != nullptr; }
  /// From the next cycle on.
  void trace(bool traced) noexcept;
  CycleCost cycle();
  /// False when the mode does not come within `cycles`.
  bool reach(Mode mode, int cycles);
  ControlLoop& loop() noexcept { return *loop_; }

 private:
  Scene scene_;
  Robot robot_;
  hal::MonotonicClock stopwatch_;
  std::unique_ptr<TraceRing> ring_;
  Tracer tracer_;
  hal::VirtualBus bus_;
  TracedBus traced_bus_;
  drivers::SimDrives drives_;
  std::unique_ptr<ControlLoop> loop_;
  Instant now_{};
};

}  // namespace ivo::firmware::bench
