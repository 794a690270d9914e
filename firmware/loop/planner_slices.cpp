#include "firmware/loop/planner_slices.hpp"

#include <algorithm>

#include "config/rates.hpp"

namespace ivo::firmware {

void PlannerSlices::take_over(const planner::Plan& plan) noexcept {
  plans_[newest_] = plan;
  ShownPlan& shown = shown_.draft();
  shown.number = number_;
  shown.ready = true;
  shown.plan = plan;
  shown_.publish();
  ready_ = true;
}

void PlannerSlices::begin_anew(planner::Planner& planner) noexcept {
  planner_ = &planner;
  newest_ = followed_ == 0 ? 1 : 0;
  ++number_;
  ready_ = false;
  held_ = false;
  better_ = false;
}

void PlannerSlices::end_here(Instant now) noexcept {
  if (!ready_ && !held_ && planner_->progress().has_plan) {
    finish(now);
  }
}

void PlannerSlices::run(Instant now, hal::Clock* stopwatch, Instant until) noexcept {
  if (held_) {
    return;
  }
  think(stopwatch, now, until);
  if (better_ && now - shown_at_ >= kShownEvery) {
    show(now);
  }
}

void PlannerSlices::think(hal::Clock* stopwatch, Instant now, Instant until) noexcept {
  if (stopwatch == nullptr) {
    for (int left = rates::kPlannerUnitsPerCycle; left > 0 && !ready_;
         left -= std::max(1, planner_->last_slice_units())) {
      slice({left}, now);
    }
    return;
  }
  Instant begin = stopwatch->now();
  for (int units = pace_.units_within(until - begin); units > 0 && !ready_; units = pace_.units_within(until - begin)) {
    slice({units}, now);
    const Instant end = stopwatch->now();
    pace_.ran(planner_->last_slice_kind(), planner_->last_slice_units(), end - begin);
    begin = end;
  }
}

void PlannerSlices::slice(planner::Budget budget, Instant now) noexcept {
  const planner::Progress before = planner_->progress();
  const std::int64_t moves = planner_->moves();
  const Instant begin = tracer_.now();
  const planner::Progress progress = planner_->step(budget);
  units_ += planner_->last_slice_units();
  tracer_.slice(static_cast<std::uint8_t>(planner_->last_slice_kind()), begin, planner_->last_slice_units(),
                planner_->moves() - moves);
  if (progress.has_plan && (!before.has_plan || progress.best.expected_time_s != before.best.expected_time_s)) {
    better_ = true;
    (void)events_.push({now, EventKind::kPlanImproved, 0, progress.generation, progress.best.expected_time_s,
                        progress.best.unseen_mass});
  }
  if (progress.done) {
    finish(now);
  }
}

void PlannerSlices::finish(Instant now) noexcept {
  planner_->best_plan(plans_[newest_]);
  ready_ = true;
  show(now);
  (void)events_.push({now, EventKind::kPlanReady, 0, planner_->progress().generation, 0.0, 0.0});
}

void PlannerSlices::show(Instant now) noexcept {
  const planner::Progress progress = planner_->progress();
  ShownPlan& shown = shown_.draft();
  shown.number = number_;
  shown.generation = progress.generation;
  shown.generations = progress.generations;
  shown.ready = ready_;
  planner_->best_plan(shown.plan);
  shown_.publish();
  better_ = false;
  shown_at_ = now;
}

}  // namespace ivo::firmware
