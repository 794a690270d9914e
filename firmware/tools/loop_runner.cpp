#include "firmware/tools/loop_runner.hpp"

#include <thread>

#include "firmware/tools/terminal.hpp"

namespace ivo::firmware {
namespace {

constexpr int kObserveEveryMs = 50;
constexpr int kObserveEveryCycles = 25;

}  // namespace

LoopRunner::LoopRunner(ControlLoop& loop, RunWorld& world, Duration period, std::optional<hal::RealTimePlace> place)
    : loop_(loop), world_(world), period_(period), place_(place), scheduler_(Instant{}, period) {}

void LoopRunner::run(const std::function<void(int wait_ms)>& observe) {
  world_.own_time() ? run_in_this_thread(observe) : run_beside(observe);
  observe(0);
}

void LoopRunner::run_in_this_thread(const std::function<void(int wait_ms)>& observe) {
  const Instant begin = world_.clock().now();
  scheduler_ = Scheduler(begin, period_);
  loop_.open(begin);
  for (int cycle = 0; one_cycle(); ++cycle) {
    if (cycle % kObserveEveryCycles == 0) {
      observe(0);
    }
  }
}

void LoopRunner::run_beside(const std::function<void(int wait_ms)>& observe) {
  std::atomic<bool> running{true};
  std::thread thread([&] {
    cycles();
    running.store(false);
  });
  try {
    while (running.load()) {
      observe(kObserveEveryMs);
    }
  } catch (...) {  // out of memory, say: the loop goes on until the robot stands
    loop_.request_stop();
    thread.join();
    throw;
  }
  thread.join();
}

// What was granted when it was tried is granted now. If not, a robot stays where it is.
void LoopRunner::cycles() {
  hal::name_thread("ivo-loop");
  hal::leave_signals_to_others();
  if (place_) {
    if (const Result<void> entered = hal::enter_real_time(*place_); !entered) {
      complain(entered.error());
      if (world_.time() == RunWorld::Time::kReal) {
        loop_.request_stop();
      }
    }
  }
  const Instant begin = world_.clock().now();
  scheduler_ = Scheduler(begin, period_);
  loop_.open(begin);
  const hal::PageFaults before = hal::page_faults();
  while (one_cycle()) {
  }
  const hal::PageFaults after = hal::page_faults();
  page_faults_ = {after.minor - before.minor, after.major - before.major};
  ended_.store(true);
}

bool LoopRunner::one_cycle() {
  hal::Clock& clock = world_.clock();
  const Instant started = clock.now();
  loop_.cycle({.now = started, .skipped = skipped_, .woke_late = started - scheduler_.deadline()});
  world_.after_cycle(loop_);
  if (loop_.finished() || world_.stalled()) {
    return false;
  }
  skipped_ = scheduler_.advance(started, clock.now());
  clock.sleep_until(scheduler_.deadline());
  return true;
}

}  // namespace ivo::firmware
