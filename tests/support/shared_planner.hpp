// One planner a test program: it is too large for the stack and not worth a second one.
#pragma once

#include "planner/search/planner.hpp"

namespace ivo::test {

inline planner::Planner& shared_planner() {
  static planner::Planner planner;
  return planner;
}

/// As long as it takes; the plan lies in a static and lasts until the next call.
inline const planner::Plan& plan_of(planner::Planner& planner) {
  static planner::Plan plan;
  while (!planner.step({1'000'000}).done) {
  }
  planner.best_plan(plan);
  return plan;
}

}  // namespace ivo::test
