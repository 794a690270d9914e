#include "firmware/tools/profile/cycle_profile.hpp"

namespace ivo::firmware {

void CycleProfile::take(const TraceEvent& event) {
  ++events;
  const Duration lasted(event.lasted_ns);
  switch (event.kind) {
    case TraceKind::kCycleBegan: {
      const TracedCycle cycle = event.get<TracedCycle>();
      wake_up.add(Duration(cycle.latency_ns));
      skipped += cycle.skipped;
      phases_.fill(Duration::zero());
      break;
    }
    case TraceKind::kPhase:
      phases_.at(event.code) = lasted;
      break;
    case TraceKind::kSlice: {
      const TracedWork work = event.get<TracedWork>();
      StepFigures& step = steps.at(event.code);
      step.slices.add(lasted);
      if (work.units > 0) {
        step.thousand_units.add(lasted * 1000 / work.units);
      }
      step.units += work.units;
      step.moves += work.moves;
      break;
    }
    case TraceKind::kCycleEnded: {
      CycleFigures& figures = event.get<TracedWork>().units > 0 ? planning : driving;
      figures.cycle.add(lasted);
      for (std::size_t phase = 0; phase < kPhases; ++phase) {
        figures.phases.at(phase).add(phases_.at(phase));
      }
      break;
    }
    default:
      break;  // what happened, not how long it took
  }
}

}  // namespace ivo::firmware
