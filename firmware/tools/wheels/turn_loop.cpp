#include "firmware/tools/wheels/turn_loop.hpp"

#include "firmware/loop/overrun_policy.hpp"
#include "firmware/tools/stop_signal.hpp"

namespace ivo::firmware::wheels {

TurnLoop::TurnLoop(World& world)
    : world_(world), turner_(world.bus(), world.robot(), world.inputs()), thread_([this] { run(); }) {}

TurnLoop::~TurnLoop() {
  end();
  thread_.join();
}

void TurnLoop::run() noexcept {
  hal::Clock& clock = world_.clock();
  const Instant begin = clock.now();
  Scheduler scheduler(begin, world_.robot().cycle);
  std::int64_t skipped = 0;
  turner_.open(begin);
  while (!turner_.ended()) {
    const Instant started = clock.now();
    for (TurnOrder order; orders_.pop(order);) {
      turner_.give(order);
    }
    status_.write(turner_.cycle(started, skipped,
                                {.hold = hold_.exchange(false, std::memory_order_relaxed),
                                 .other = other_.exchange(false, std::memory_order_relaxed),
                                 .end = end_.load(std::memory_order_relaxed) || stop_asked()}));
    world_.after_cycle();
    skipped = scheduler.advance(started, clock.now());
    clock.sleep_until(scheduler.deadline());
  }
  running_.store(false, std::memory_order_release);
}

}  // namespace ivo::firmware::wheels
