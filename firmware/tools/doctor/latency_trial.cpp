#include "firmware/tools/doctor/latency_trial.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <thread>

#include "hal/linux/monotonic_clock.hpp"

namespace ivo::firmware::doctor {
namespace {

hal::PageFaults since(const hal::PageFaults& before) {
  const hal::PageFaults now = hal::page_faults();
  return {now.minor - before.minor, now.major - before.major};
}

/// Fills `run.late`, whose memory is there already: nothing is allocated between two wake-ups.
void sleep_and_wake(LatencyRun& run, Duration length) {
  hal::MonotonicClock clock;
  const hal::PageFaults before = hal::page_faults();
  const Instant begin = clock.now();
  const Instant end = begin + length;
  for (Instant deadline = begin + run.period; deadline < end && run.late.size() < run.late.capacity();) {
    clock.sleep_until(deadline);
    const Duration late = clock.now() - deadline;
    const Duration::rep lost = late / run.period;  // periods keep their phase, as the loop's do
    run.late.push_back(late);
    run.lost_periods += static_cast<std::uint64_t>(lost);
    deadline += (1 + lost) * run.period;
  }
  run.faults = since(before);
}

}  // namespace

LatencyRun try_latency(const LatencyPlan& plan) {
  LatencyRun run;
  run.period = plan.period;
  run.place = plan.place;
  run.late.resize(static_cast<std::size_t>(std::max<Duration::rep>(1, plan.length / plan.period)));  // touched
  run.late.clear();
  run.locked = plan.lock_memory && hal::lock_memory().ok();
  std::thread([&] {
    hal::name_thread("ivo-doctor");
    hal::leave_signals_to_others();
    run.real_time = hal::enter_real_time(run.place).ok();
    if (!run.real_time && run.place.cpu) {  // the CPU may be what was refused
      run.place.cpu.reset();
      run.real_time = hal::enter_real_time(run.place).ok();
    }
    sleep_and_wake(run, std::max(plan.length, 2 * plan.period));
  }).join();
  if (run.locked) {
    (void)munlockall();
  }
  std::ranges::sort(run.late);
  return run;
}

}  // namespace ivo::firmware::doctor
