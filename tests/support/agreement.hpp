// How far a number may lie from one worked out in doubles, in either build.
#pragma once

#include "planner/numeric/scalar.hpp"

namespace ivo::test {

/// Of one mass: half a unit, in fixed point as much again that the cell before has left, and a double's own rounding.
inline constexpr double kMassAgreement = (planner::kFixedPoint ? 1.0 : 0.5) * planner::kMassUnit + 1e-15;
/// Of a sum of `cells` masses.
[[nodiscard]] constexpr double sum_agreement(int cells) { return 0.5 * planner::kMassUnit * cells + 1e-12; }

/// Of ET_c, of times and of an unseen mass. In fixed point each edge's time is rounded down to 2^-16 s.
inline constexpr double kAgreement = planner::kFixedPoint ? 5e-3 : 1e-9;
/// Of ET and EST: in fixed point a cell seen at the very end of a step may count in the next.
inline constexpr double kStepAgreement = planner::kFixedPoint ? 0.1 : 1e-9;

}  // namespace ivo::test
