// `ivo bench loop`: what a cycle costs by phase on the virtual bus, planning, standing and driving, traced and not; and
// what the loop's objects weigh. The same again in the guest whose time nobody disturbs.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/record/recording_bus.hpp"
#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/guest.hpp"
#include "firmware/tools/bench/loop/loop_rig.hpp"
#include "hal/linux/real_time.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr int kCycles = 4000;
constexpr int kQuickCycles = 400;
constexpr int kBlock = 20;                    // cycles traced, then as many not: neither has the better minutes
constexpr int kLearning = 500;                // cycles until the pace of planning is known
constexpr int kEndless = 1'000'000;           // generations
constexpr int kShort = 2;                     // ditto
constexpr int kPatience = 20'000;             // cycles
constexpr int kSpeedUp = 1500;                // cycles until the robot is at speed
constexpr double kTracingMost_percent = 3.0;  // of a cycle's time
constexpr double kPeriod_us = 2000.0;

struct Costs {
  std::vector<double> whole_us;
  std::array<std::vector<double>, kPhases> phases_us;
  std::vector<double> planner_units;

  void add(const CycleCost& cost) {
    whole_us.push_back(cost.whole_us);
    planner_units.push_back(cost.planner_units);
    for (std::size_t i = 0; i < kPhases; ++i) {
      phases_us[i].push_back(cost.phases_us[i]);
    }
  }
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Of one thing that the robot does.
struct Measured {
  const char* doing = "";
  Costs plain;
  Costs traced;
};

Measured measure(LoopRig& rig, const char* doing, int cycles) {
  Measured measured{doing, {}, {}};
  for (int i = 0; i < 2 * cycles; ++i) {
    const bool tracing = i / kBlock % 2 == 1;
    rig.trace(tracing);
    const CycleCost cost = rig.cycle();
    (tracing ? measured.traced : measured.plain).add(cost);
  }
  rig.trace(false);
  return measured;
}

/// Slices fill what time there is, so what tracing takes, the planner loses; elsewhere the cycle is longer by it.
double tracing_percent(const Measured& measured) {
  const double units = median(measured.plain.planner_units);
  return 100.0 * (units > 0.0 ? 1.0 - median(measured.traced.planner_units) / units
                              : (median(measured.traced.whole_us) - median(measured.plain.whole_us)) / kPeriod_us);
}

void add(const std::vector<Measured>& all, Sheet& sheet) {
  for (const Measured& measured : all) {
    sheet.add_median("cycle", measured.doing, measured.plain.whole_us, "us");
  }
  for (const Measured& measured : all) {
    sheet.add_median("cycle, traced", measured.doing, measured.traced.whole_us, "us");
  }
  for (std::size_t i = 0; i < kPhases; ++i) {
    for (const Measured& measured : all) {
      sheet.add_median(std::string(name_of(static_cast<Phase>(i))), measured.doing, measured.plain.phases_us[i], "us");
    }
  }
  for (const Measured& measured : all) {
    sheet.add("tracing, of a period", measured.doing, tracing_percent(measured), "%", Target{kTracingMost_percent});
  }
}

void add_sizes(Sheet& sheet) {
  const auto add = [&](const std::string& object, std::size_t bytes) {
    sheet.add(object, "size", static_cast<double>(bytes) / 1024.0, "KiB");
  };
  add("planner", sizeof(planner::Planner));
  for (const planner::Planner::Part& part : planner::Planner::parts()) {
    add("  of it " + std::string(part.name), part.bytes);
  }
  add("control loop", sizeof(ControlLoop));
  add("  of it planner slices, with three plans", sizeof(PlannerSlices));
  add("  of it drives", sizeof(drivers::DriveGroup));
  add("  of it guarded bus", sizeof(GuardedBus));
  add("  of it search run", sizeof(SearchRun));
  add("  of it path follower", sizeof(PathFollower));
  add("  of it phase times", sizeof(PhaseTimes));
  add("  of it events", sizeof(EventRing));
  add("  of it status, three of them", sizeof(Latest<LoopStatus>));
  add("record of frames", sizeof(FrameRing));
  add("trace", sizeof(TraceRing));
}

/// Why not, in one line; empty when all was measured.
std::string measure_all(int cycles, std::vector<Measured>& all) {
  {
    LoopRig rig(kEndless);
    if (!rig.ready()) {
      return "the planner refuses open ground";
    }
    for (int i = 0; i < kLearning; ++i) {
      (void)rig.cycle();
    }
    all.push_back(measure(rig, "planning", cycles / 4));
  }
  LoopRig rig(kShort);
  if (!rig.ready() || !rig.reach(Mode::kAwaitingConsent, kPatience)) {
    return "the drives do not get ready";
  }
  all.push_back(measure(rig, "standing", cycles));
  (void)rig.loop().command(OperatorCommand::kConsent);
  if (!rig.reach(Mode::kSearching, kPatience)) {
    return "nobody sets off";
  }
  for (int i = 0; i < kSpeedUp; ++i) {
    (void)rig.cycle();
  }
  all.push_back(measure(rig, "driving", cycles));
  return {};
}

}  // namespace

void loop(const Options& options, Sheet& sheet) {
  sheet.clock(clock_of_this_kernel());
  if (counts_instructions()) {
    (void)hal::enter_real_time({});
  }
  std::vector<Measured> all;
  if (const std::string refusal = measure_all(options.quick ? kQuickCycles : kCycles, all); !refusal.empty()) {
    return sheet.skip("cycle", refusal);
  }
  add(all, sheet);
  if (counts_instructions()) {
    return;  // the other half of the bench is on the host
  }
  add_sizes(sheet);
  Result<std::vector<Record>> records = records_from_guest(Guest::kRealTime, "loop", options);
  records ? sheet.take(std::move(records).value()) : sheet.skip("guest", records.error().message);
}

}  // namespace ivo::firmware::bench
