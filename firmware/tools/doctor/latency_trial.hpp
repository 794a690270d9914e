// How late is a thread woken that asked for a time? Measured as the control loop sleeps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/base/time.hpp"
#include "hal/linux/real_time.hpp"

namespace ivo::firmware::doctor {

struct LatencyPlan {
  Duration period = std::chrono::milliseconds(2);  ///< of wake-ups: a cycle
  Duration length = std::chrono::seconds(5);
  hal::RealTimePlace place{};  ///< priority and CPU, where they are granted
  bool lock_memory = true;     ///< where that is granted
};

struct LatencyRun {
  Duration period{};
  std::vector<Duration> late;      ///< of each wake-up behind the time that was asked for, sorted; at least one
  std::uint64_t lost_periods = 0;  ///< in which there was no wake-up at all
  hal::PageFaults faults;          ///< of the thread while it was measured
  bool real_time = false;          ///< it was a SCHED_FIFO thread
  bool locked = false;             ///< with locked memory
  hal::RealTimePlace place{};      ///< that it had, when it was one
};

/// Sleeps and wakes for as long as `plan` says, on a thread of its own, by clock_nanosleep to absolute times of
/// CLOCK_MONOTONIC. What the kernel does not grant is left out and told. Memory is unlocked again.
[[nodiscard]] LatencyRun try_latency(const LatencyPlan& plan);

}  // namespace ivo::firmware::doctor
