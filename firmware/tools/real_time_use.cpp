#include "firmware/tools/real_time_use.hpp"

namespace ivo::firmware {
namespace {

Result<void> obtain(const hal::RealTimePlace& place) {
  if (Result<void> granted = hal::may_enter_real_time(place); !granted) {
    return granted;
  }
  return hal::lock_memory();
}

}  // namespace

Result<RealTimeUse> real_time_use(RunWorld::Time time, const LoopParameters& loop, bool without) {
  if (time == RunWorld::Time::kSimulated) {
    return RealTimeUse{};
  }
  const bool simulated_bus = time == RunWorld::Time::kRealOnSimulatedBus;
  if (without) {
    return RealTimeUse{{},
                       simulated_bus ? "ordinary scheduling (--no-real-time)"
                                     : "NOT IN REAL TIME (--no-real-time): cycles may be late, memory is not locked"};
  }
  const hal::RealTimePlace place{.priority = loop.priority, .cpu = loop.cpu};
  if (const Result<void> granted = obtain(place); !granted) {
    if (!simulated_bus) {
      return Error{granted.error().message + "; a robot is driven in real time, or with --no-real-time at your risk"};
    }
    return RealTimeUse{{}, "ordinary scheduling, which does for a simulated bus: " + granted.error().message};
  }
  return RealTimeUse{place, "real time, SCHED_FIFO " + std::to_string(place.priority) +
                                (place.cpu ? " on CPU " + std::to_string(*place.cpu) : std::string()) +
                                ", memory locked"};
}

}  // namespace ivo::firmware
