// The planner within the loop: slices of counted work in what a cycle leaves over. How much a cycle does never changes
// the plan, only when it is ready.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "config/base/latest.hpp"
#include "config/base/time.hpp"
#include "firmware/loop/planner_pace.hpp"
#include "firmware/record/event.hpp"
#include "firmware/record/tracer.hpp"
#include "hal/api/clock.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware {

/// A plan for others to see: the one that is ready, or the best so far.
struct ShownPlan {
  std::uint32_t number = 0;  ///< of the plan; 0: none is shown yet
  int generation = 0;
  int generations = 0;
  bool ready = false;
  planner::Plan plan;
};

class PlannerSlices {
 public:
  static constexpr Duration kShownEvery = std::chrono::milliseconds(250);

  /// All outlive this.
  PlannerSlices(planner::Planner& planner, EventRing& events, Tracer& tracer) noexcept
      : planner_(&planner), events_(events), tracer_(tracer) {}

  /// A plan that was made before: nothing is left to think of. Before the first cycle.
  void take_over(const planner::Plan& plan) noexcept;

  /// A plan is to be made anew: none is ready until begin_anew() or go_back().
  void hold() noexcept { held_ = true; }
  /// With `planner`, which is prepared and outlives this. The plan that is followed stays as it is.
  void begin_anew(planner::Planner& planner) noexcept;
  /// As before hold().
  void go_back() noexcept { held_ = false; }
  /// The best plan so far is the plan; nothing without one.
  void end_here(Instant now) noexcept;

  /// One cycle's share, until the plan is ready. `now`: of the cycle, for its events. With a `stopwatch` slices end
  /// before `until` on it; without one the share is rates::kPlannerUnitsPerCycle, which is the same on every machine.
  /// Cost: the share; in a cycle in which a plan is shown (four times a second at most, when there is a better one), a
  /// copy of it too, and in the one in which it is ready two.
  void run(Instant now, hal::Clock* stopwatch, Instant until) noexcept;

  [[nodiscard]] bool ready() const noexcept { return ready_ && !held_; }
  [[nodiscard]] bool held() const noexcept { return held_; }
  /// For the loop, once ready.
  [[nodiscard]] const planner::Plan& plan() const noexcept { return plans_[newest_]; }
  /// The plan is followed from here on, and stays as it is until another is.
  void follow() noexcept {
    followed_ = newest_;
    followed_number_ = number_;
  }
  /// A plan is ready that is not the one followed.
  [[nodiscard]] bool newer() const noexcept { return ready() && followed_ != newest_; }
  [[nodiscard]] std::uint32_t number() const noexcept { return number_; }
  /// Of the plan that is followed; 0: none yet.
  [[nodiscard]] std::uint32_t followed_number() const noexcept { return followed_number_; }
  /// For one other thread.
  [[nodiscard]] const ShownPlan& shown() noexcept { return shown_.read(); }
  [[nodiscard]] planner::Progress progress() const noexcept { return planner_->progress(); }
  /// The one that thinks or has thought last.
  [[nodiscard]] const planner::Planner& planner() const noexcept { return *planner_; }
  /// Work so far.
  [[nodiscard]] std::int64_t units() const noexcept { return units_; }
  [[nodiscard]] const PlannerPace& pace() const noexcept { return pace_; }

 private:
  static constexpr std::size_t kNone = 2;

  void think(hal::Clock* stopwatch, Instant now, Instant until) noexcept;
  void slice(planner::Budget budget, Instant now) noexcept;
  void finish(Instant now) noexcept;
  void show(Instant now) noexcept;

  planner::Planner* planner_;
  EventRing& events_;
  Tracer& tracer_;
  PlannerPace pace_;
  std::int64_t units_ = 0;
  std::uint32_t number_ = 1;
  std::uint32_t followed_number_ = 0;
  bool ready_ = false;
  bool held_ = false;
  bool better_ = false;  // than what is shown
  Instant shown_at_{};
  std::array<planner::Plan, 2> plans_{};
  std::size_t newest_ = 0;        // that is, or will be, ready
  std::size_t followed_ = kNone;  // never written to
  Latest<ShownPlan> shown_;
};

}  // namespace ivo::firmware
