// What the search computes with: doubles, or fixed point when the planner is built with IVO_PLANNER_FIXED (CMake
// option). Tables - graph, sight, prior - are made with doubles in both; from the first ant on a fixed-point build uses
// whole numbers for trails, masses, times and costs; lengths and draws use operations
// that IEEE 754 rounds alike everywhere (+, -, *, /, square root, no contraction).
//
// | type       | holds                         | fixed format | range       | resolution |
// | ---------- | ----------------------------- | ------------ | ----------- | ---------- |
// | Seconds    | times, durations              | Q47.16       | to 2^47 s   | 15 us      |
// | Pace       | seconds a sight point         | Q31.32       | to 2^31     | 2.3e-10    |
// | Mass       | probability, and mass x steps | Q32.31       | to 2^32     | 4.7e-10    |
// | MassTime   | mass x seconds; mass_time()   | Q16.47       | to 65,536 s | 7e-15      |
// | Trail      | tau rho; roulette.hpp         | UQ2.30       | to 4        | 9.3e-10    |
// | Visibility | eta^beta                      | UQ14.18      | to 2^14     | 3.8e-6     |
// | Weight     | tau rho eta^beta              | UQ26.38      | to 2^26     | 3.6e-12    |
#pragma once

#include <cstdint>

#include "planner/numeric/fixed.hpp"

#ifndef IVO_PLANNER_FIXED
#define IVO_PLANNER_FIXED 0
#endif

namespace ivo::planner {

inline constexpr bool kFixedPoint = IVO_PLANNER_FIXED != 0;

#if IVO_PLANNER_FIXED
using Seconds = Fixed<16>;
using Pace = Fixed<32>;
using Mass = Fixed<31>;
using MassTime = Fixed<47>;
#else
using Seconds = double;
using Pace = double;
using Mass = double;
using MassTime = double;
#endif

/// When the point-th sight point is passed.
[[nodiscard]] constexpr Seconds after_points(Pace pace, int points) noexcept {
#if IVO_PLANNER_FIXED
  return round_to<Seconds>(pace * points);
#else
  return pace * points;
#endif
}

/// A mass seen at `time_s`, which in fixed point counts at most as `kLongest`: so no sum of them over a prior leaves
/// MassTime's range. Of a score that is 18 hours; of a judgement, which may add a fine of 2.5 times as much, 4.5.
inline constexpr int kLongest_s = 65'000;
inline constexpr int kLongestJudged_s = 16'384;
template <int kLongest = kLongest_s>
[[nodiscard]] constexpr MassTime mass_time(Mass mass, Seconds time_s) noexcept {
#if IVO_PLANNER_FIXED
  return mass * (time_s < Seconds(kLongest) ? time_s : Seconds(kLongest));
#else
  return mass * time_s;
#endif
}

/// Sums of a prior's masses are exact in both builds, whatever the order: a cell holds a multiple of this.
inline constexpr double kMassUnit = kFixedPoint ? 0x1p-31 : 0x1p-50;

[[nodiscard]] constexpr double to_double(double value) noexcept { return value; }
template <int F>
[[nodiscard]] constexpr double to_double(Fixed<F> value) noexcept {
  return static_cast<double>(value);
}

/// A mass of a cell, to the nearest unit.
[[nodiscard]] constexpr Mass mass_from(double value) noexcept {
  return Mass(static_cast<double>(static_cast<std::int64_t>(value / kMassUnit + 0.5)) * kMassUnit);
}

/// Of cells one after the other: in fixed point what rounding takes from one the next gets, so that a sum over many is
/// off by a unit, and not by half a unit each where all are alike. One of a million cells has some two thousand. One of
/// a single unit is rounded alone: it must not come to nothing.
class MassRounding {
 public:
  [[nodiscard]] constexpr Mass round(double value) noexcept {
    if (!kFixedPoint || value < 1.5 * kMassUnit) {
      return mass_from(value);
    }
    const Mass mass = mass_from(value + rest_);
    rest_ += value - to_double(mass);
    return mass;
  }

 private:
  double rest_ = 0.0;
};

}  // namespace ivo::planner
