// The planner within the loop: slices of counted work in what a cycle leaves over. How much a cycle does never changes
// the plan, only when it is ready.
#pragma once

#include <cstdint>

#include "config/base/latest.hpp"
#include "config/base/time.hpp"
#include "firmware/loop/planner_pace.hpp"
#include "firmware/record/event.hpp"
#include "firmware/record/tracer.hpp"
#include "hal/api/clock.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware {

class PlannerSlices {
 public:
  /// All outlive this.
  PlannerSlices(planner::Planner& planner, EventRing& events, Tracer& tracer) noexcept
      : planner_(planner), events_(events), tracer_(tracer) {}

  /// A plan that was made before: nothing is left to think of. Before the first cycle.
  void take_over(const planner::Plan& plan) noexcept;

  /// One cycle's share, until the plan is ready. `now`: of the cycle, for its events. With a `stopwatch` slices end
  /// before `until` on it; without one the share is rates::kPlannerUnitsPerCycle, which is the same on every machine.
  /// Cost: the share; in the cycle in which the plan is ready, its copies too.
  void run(Instant now, hal::Clock* stopwatch, Instant until) noexcept;

  [[nodiscard]] bool ready() const noexcept { return ready_; }
  /// For the loop, once ready.
  [[nodiscard]] const planner::Plan& plan() const noexcept { return plan_; }
  /// For one other thread, once a status has shown it ready.
  [[nodiscard]] const planner::Plan& shown() noexcept { return shown_.read(); }
  [[nodiscard]] planner::Progress progress() const noexcept { return planner_.progress(); }
  /// Work so far.
  [[nodiscard]] std::int64_t units() const noexcept { return units_; }
  [[nodiscard]] const PlannerPace& pace() const noexcept { return pace_; }

 private:
  void slice(planner::Budget budget, Instant now) noexcept;

  planner::Planner& planner_;
  EventRing& events_;
  Tracer& tracer_;
  PlannerPace pace_;
  std::int64_t units_ = 0;
  bool ready_ = false;
  planner::Plan plan_;
  Latest<planner::Plan> shown_;
};

}  // namespace ivo::firmware
