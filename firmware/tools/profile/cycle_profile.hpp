// Where the time of a run's cycles went, by phase and by step of the planner.
#pragma once

#include <array>
#include <cstdint>

#include "config/base/time_histogram.hpp"
#include "firmware/loop/phase.hpp"
#include "firmware/record/trace_sink.hpp"
#include "planner/search/slice_kind.hpp"

namespace ivo::firmware {

/// Cycles of one sort: those that plan and those that do not are two different loads.
struct CycleFigures {
  TimeHistogram cycle;
  std::array<TimeHistogram, kPhases> phases;
};

/// What one step of the planner came to.
struct StepFigures {
  TimeHistogram slices;
  TimeHistogram thousand_units;  ///< what so many cost, slice by slice
  std::int64_t units = 0;
  std::int64_t moves = 0;

  /// All its units at the median cost: what the step takes where nobody else wants the processor.
  [[nodiscard]] Duration undisturbed() const noexcept { return thousand_units.quantile(0.5) * units / 1000; }
};

class CycleProfile final : public TraceSink {
 public:
  CycleFigures planning;
  CycleFigures driving;  ///< all cycles without planner work
  TimeHistogram wake_up;
  std::array<StepFigures, planner::kSliceKinds> steps;
  std::int64_t skipped = 0;  ///< periods
  std::uint64_t events = 0;

  void take(const TraceEvent& event) override;
  void write_out() override {}
  [[nodiscard]] Result<void> close(std::uint64_t /*lost*/) override { return {}; }
  [[nodiscard]] std::string summary() const override { return {}; }

 private:
  std::array<Duration, kPhases> phases_{};  // of the cycle under way
};

}  // namespace ivo::firmware
