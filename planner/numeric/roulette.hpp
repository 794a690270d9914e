// Weights of a roulette wheel (Eq. 2): trail times visibility, and a draw among running sums of them.
#pragma once

#include <cstdint>

#include "planner/numeric/rng.hpp"
#include "planner/numeric/scalar.hpp"

namespace ivo::planner {

#if IVO_PLANNER_FIXED

using Trail = std::uint32_t;  ///< tau rho, 30 bits behind the point; at most 1 (tau_max rho = 1 / C, C at least 1 s)
using Visibility = std::uint32_t;  ///< eta^beta, 18 bits behind the point; at least 1 unit, below 2^14
using Weight = std::uint64_t;      ///< their product, 38 bits behind the point

inline constexpr int kTrailBits = 30;
inline constexpr int kVisibilityBits = 18;

[[nodiscard]] constexpr Visibility visibility_from(double value) noexcept {
  const double units = value * (1 << kVisibilityBits) + 0.5;
  return units < 1.0 ? 1U : units > 4294967295.0 ? 4294967295U : static_cast<Visibility>(units);
}
[[nodiscard]] constexpr Weight weight_of(Trail trail, Visibility visibility) noexcept {
  return (static_cast<std::uint64_t>(trail) * visibility) >> (kTrailBits + kVisibilityBits - 38);
}
/// (value / best)^beta of two sums in one unit, `best` the larger one and above 0.
[[nodiscard]] constexpr Visibility visibility_of(std::uint64_t value, std::uint64_t best, int beta) noexcept {
  const std::uint64_t ratio = (value << 16U) / best;
  std::uint64_t power = 1U << 16U;
  for (int k = 0; k < beta; ++k) {
    power = power * ratio >> 16U;
  }
  const std::uint64_t units = power << (kVisibilityBits - 16);
  return units == 0 ? 1U : static_cast<Visibility>(units);
}
/// Uniform in [0, sum).
[[nodiscard]] constexpr Weight draw_below(Weight sum, Rng& rng) noexcept {
  const std::uint64_t part = rng.next() >> 32U;
  return (sum >> 32U) * part + (((sum & 0xFFFFFFFFU) * part) >> 32U);
}

#else

using Trail = double;
using Visibility = double;
using Weight = double;

[[nodiscard]] constexpr Visibility visibility_from(double value) noexcept { return value; }
[[nodiscard]] constexpr Weight weight_of(Trail trail, Visibility visibility) noexcept { return trail * visibility; }
/// (value / best)^beta of two sums in one unit, `best` the larger one and above 0.
[[nodiscard]] constexpr Visibility visibility_of(double value, double best, int beta) noexcept {
  const double ratio = value / best;
  double power = 1.0;
  for (int k = 0; k < beta; ++k) {
    power *= ratio;
  }
  return power;
}
/// Uniform in [0, sum).
[[nodiscard]] constexpr Weight draw_below(Weight sum, Rng& rng) noexcept { return rng.unit() * sum; }

#endif

}  // namespace ivo::planner
