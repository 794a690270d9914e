#include "firmware/loop/planner_slices.hpp"

#include <algorithm>

#include "config/rates.hpp"

namespace ivo::firmware {

void PlannerSlices::take_over(const planner::Plan& plan) noexcept {
  plan_ = plan;
  shown_.write(plan_);
  ready_ = true;
}

void PlannerSlices::run(Instant now, hal::Clock* stopwatch, Instant until) noexcept {
  if (stopwatch == nullptr) {
    for (int left = rates::kPlannerUnitsPerCycle; left > 0 && !ready_;
         left -= std::max(1, planner_.last_slice_units())) {
      slice({left}, now);
    }
    return;
  }
  Instant begin = stopwatch->now();
  for (int units = pace_.units_within(until - begin); units > 0 && !ready_; units = pace_.units_within(until - begin)) {
    slice({units}, now);
    const Instant end = stopwatch->now();
    pace_.ran(planner_.last_slice_kind(), planner_.last_slice_units(), end - begin);
    begin = end;
  }
}

void PlannerSlices::slice(planner::Budget budget, Instant now) noexcept {
  const planner::Progress before = planner_.progress();
  const std::int64_t moves = planner_.moves();
  const Instant begin = tracer_.now();
  const planner::Progress progress = planner_.step(budget);
  units_ += planner_.last_slice_units();
  tracer_.slice(static_cast<std::uint8_t>(planner_.last_slice_kind()), begin, planner_.last_slice_units(),
                planner_.moves() - moves);
  if (progress.has_plan && (!before.has_plan || progress.best.expected_time_s != before.best.expected_time_s)) {
    (void)events_.push({now, EventKind::kPlanImproved, 0, progress.generation, progress.best.expected_time_s,
                        progress.best.unseen_mass});
  }
  if (progress.done) {
    planner_.best_plan(plan_);
    shown_.write(plan_);
    ready_ = true;
    (void)events_.push({now, EventKind::kPlanReady, 0, progress.generation, 0.0, 0.0});
  }
}

}  // namespace ivo::firmware
