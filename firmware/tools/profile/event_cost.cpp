#include "firmware/tools/profile/event_cost.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "firmware/loop/phase.hpp"
#include "firmware/record/tracer.hpp"

namespace ivo::firmware {
namespace {

constexpr int kBursts = 1000;
constexpr int kPhasesEach = 3;  // of a burst: as many events as a cycle with its frames

}  // namespace

double measured_event_cost_ns(hal::Clock& stopwatch) {
  const auto ring = std::make_unique<TraceRing>();
  Tracer tracer(stopwatch, ring.get());
  std::vector<double> costs;
  for (int burst = 0; burst < kBursts; ++burst) {
    const Instant begin = stopwatch.now();
    for (int round = 0; round < kPhasesEach; ++round) {
      for (std::size_t phase = 0; phase < kPhases; ++phase) {
        tracer.phase(static_cast<std::uint8_t>(phase), begin, begin);
      }
    }
    const Duration took = stopwatch.now() - begin;
    costs.push_back(static_cast<double>(took.count()) / (kPhasesEach * static_cast<double>(kPhases)));
  }
  std::nth_element(costs.begin(), costs.begin() + kBursts / 2, costs.end());
  return costs[kBursts / 2];
}

}  // namespace ivo::firmware
