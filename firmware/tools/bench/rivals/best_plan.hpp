// The best of the plans that a rival has made: complete ones by exact ET_c, before incomplete ones by unseen mass.
#pragma once

#include <optional>
#include <utility>

#include "firmware/tools/bench/rivals/rival_score.hpp"

namespace ivo::firmware::rivals {

[[nodiscard]] inline bool better(const planner::PlanScore& a, const planner::PlanScore& b) {
  if (a.complete != b.complete) {
    return a.complete;
  }
  return a.complete ? a.expected_time_continuous_s < b.expected_time_continuous_s : a.unseen_mass < b.unseen_mass;
}

class BestPlan {
 public:
  explicit BestPlan(const RivalProblem& problem) : problem_(problem) {}

  /// True when it is the best so far. Cost: its exact score.
  bool offer(Waypoints waypoints, bool completed_greedily) {
    const planner::PlanScore plan_score = score(problem_, waypoints);
    if (best_ && !better(plan_score, best_->score)) {
      return false;
    }
    best_ = RivalPlan{std::move(waypoints), plan_score, completed_greedily, 0};
    return true;
  }
  [[nodiscard]] bool empty() const { return !best_.has_value(); }
  [[nodiscard]] RivalPlan take(int tries) {
    best_->tries = tries;
    return std::move(*best_);
  }

 private:
  const RivalProblem& problem_;
  std::optional<RivalPlan> best_;
};

}  // namespace ivo::firmware::rivals
