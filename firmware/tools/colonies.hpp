// The search of one mission by colonies side by side, a thread each. What they find depends on their number and the
// seed, never on timing.
#pragma once

#include "config/base/result.hpp"
#include "planner/search/planner.hpp"

namespace ivo::firmware {

class Colonies {
 public:
  static constexpr int kMost = 1;

  /// `planner` is prepared and outlives this. Refuses more than kMost.
  [[nodiscard]] static Result<Colonies> create(planner::Planner& planner, int count);

  /// A part of the search, some milliseconds long. Nothing when done.
  planner::Progress search_on();
  [[nodiscard]] planner::Progress progress() const { return planner_->progress(); }
  /// The best plan so far of all colonies; there must be one.
  void best_plan(planner::Plan& plan) const { planner_->best_plan(plan); }

 private:
  explicit Colonies(planner::Planner& planner) : planner_(&planner) {}

  planner::Planner* planner_;
};

}  // namespace ivo::firmware
