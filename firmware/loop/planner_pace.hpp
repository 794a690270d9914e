// How much planner work fits into the time that is left of a cycle, by what work has really cost.
#pragma once

#include <array>

#include "config/base/time.hpp"
#include "planner/search/slice_kind.hpp"

namespace ivo::firmware {

/// Keeps an upper estimate of a work unit's cost (planner/search/search.hpp) for each kind of slice: a dearer slice
/// raises it at once, cheaper ones lower it slowly. Nobody knows of what kind the next slice is, so the dearest one
/// counts. It begins with a slow processor. Times are of one stopwatch.
class PlannerPace {
 public:
  PlannerPace() noexcept;

  /// The largest slice that ends within `left` with a margin; 0 when none does.
  [[nodiscard]] int units_within(Duration left) const noexcept;
  /// A slice came to `units` and took `took`.
  void ran(planner::SliceKind kind, int units, Duration took) noexcept;
  /// ns, of the dearest kind.
  [[nodiscard]] double unit_cost_ns() const noexcept;

 private:
  std::array<double, planner::kSliceKinds> unit_ns_{};
};

}  // namespace ivo::firmware
