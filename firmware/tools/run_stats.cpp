#include "firmware/tools/run_stats.hpp"

#include <utility>

#include "firmware/files/json_value.hpp"

namespace ivo::firmware {
namespace {

Json count_of(Duration time) { return static_cast<std::uint64_t>(time.count()); }

Json json_of(const std::string& name, const TimeHistogram& times) {
  return {{"name", name},
          {"count", times.count()},
          {"total_ns", count_of(times.total())},
          {"median_ns", count_of(times.quantile(0.5))},
          {"p99_ns", count_of(times.quantile(0.99))},
          {"p999_ns", count_of(times.quantile(0.999))},
          {"worst_ns", count_of(times.worst())}};
}

}  // namespace

std::string stats_json(const RunStats& stats) {
  constexpr int kFormat = 1;
  const LoopCounters& counters = stats.status.counters;
  Json times = Json::list();
  times.elements.push_back(json_of("wake up", stats.times.wake_up));
  times.elements.push_back(json_of("cycle", stats.times.cycle));
  for (std::size_t i = 0; i < kPhases; ++i) {
    times.elements.push_back(json_of(std::string(name_of(static_cast<Phase>(i))), stats.times.phases[i]));
  }
  return json_text({{"format", kFormat},
                    {"clock", stats.clock},
                    {"cycles", counters.cycles},
                    {"periods_skipped", counters.skipped},
                    {"page_faults", stats.page_faults.minor + stats.page_faults.major},
                    {"frames_sent", counters.bus.sent},
                    {"frames_received", counters.bus.received},
                    {"frames_not_sent", counters.bus.send_dropped},
                    {"frames_lost", counters.bus.receive_dropped},
                    {"commands_refused", counters.refused_commands},
                    {"frames_refused", counters.refused_frames},
                    {"times", std::move(times)}});
}

}  // namespace ivo::firmware
