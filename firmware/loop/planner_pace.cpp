#include "firmware/loop/planner_pace.hpp"

#include <algorithm>

#include "config/rates.hpp"

namespace ivo::firmware {
namespace {

constexpr int kLeastUnits = 500;        // a slice's own overhead would be more than its work
constexpr int kMostUnits = 1'000'000;   //
constexpr double kMargin = 0.75;        // of the time left: slices end up to a fifth over their budget (search.hpp)
constexpr double kFirstNs = 30.0;       // a slow processor's
constexpr double kDearestNs = 400.0;    // beyond it somebody else had the processor: no reason to stop for good
constexpr double kForget = 1.0 / 64.0;  // of what a cheaper slice is below the estimate
constexpr double kForgetOthers = 1.0 / 1024.0;  // of what other kinds' are above the first guess

static_assert(kMargin * rates::kThinkUntilPercent / 100 * static_cast<double>(Duration(rates::kShortestCycle).count()) /
                      kDearestNs >
                  2 * kLeastUnits,
              "however dear work has been, the next cycle thinks, and finds out that it is cheaper");

}  // namespace

PlannerPace::PlannerPace() noexcept { unit_ns_.fill(kFirstNs); }

double PlannerPace::unit_cost_ns() const noexcept { return *std::max_element(unit_ns_.begin(), unit_ns_.end()); }

int PlannerPace::units_within(Duration left) const noexcept {
  const double units = kMargin * static_cast<double>(left.count()) / unit_cost_ns();
  return units < kLeastUnits ? 0 : static_cast<int>(std::min<double>(units, kMostUnits));
}

void PlannerPace::ran(planner::SliceKind kind, int units, Duration took) noexcept {
  if (units < kLeastUnits) {
    return;  // mostly the call itself
  }
  const double cost_ns = std::min(kDearestNs, static_cast<double>(took.count()) / units);
  for (double& other_ns : unit_ns_) {
    other_ns -= kForgetOthers * std::max(0.0, other_ns - kFirstNs);
  }
  double& unit_ns = unit_ns_[static_cast<std::size_t>(kind)];
  unit_ns = std::max(cost_ns, unit_ns + kForget * (cost_ns - unit_ns));
}

}  // namespace ivo::firmware
