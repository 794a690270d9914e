// Places off the graph lie on a lattice of 1/64 m, so that they are whole numbers on every processor.
#pragma once

#include <cmath>
#include <cstdint>

#include "config/base/geometry.hpp"
#include "planner/numeric/scalar.hpp"

namespace ivo::planner {

inline constexpr int kTicksAMetre = 64;

struct Spot {
  std::int32_t x = 0;  ///< in ticks
  std::int32_t y = 0;
  friend bool operator==(const Spot&, const Spot&) = default;
};

[[nodiscard]] inline Spot spot_at(Point p) noexcept {
  return {static_cast<std::int32_t>(std::floor(p.x_m * kTicksAMetre + 0.5)),
          static_cast<std::int32_t>(std::floor(p.y_m * kTicksAMetre + 0.5))};
}
[[nodiscard]] constexpr Point point_of(Spot s) noexcept {
  return {static_cast<double>(s.x) / kTicksAMetre, static_cast<double>(s.y) / kTicksAMetre};
}

#if IVO_PLANNER_FIXED
using Metres = Fixed<20>;
using SecondsAMetre = Fixed<20>;
#else
using Metres = double;
using SecondsAMetre = double;
#endif

/// Of places less than 2^31 ticks apart. In fixed point rounded down: by less than 2^-20 m up to 4,096 m, by less than
/// a tick beyond.
[[nodiscard]] inline Metres distance(Spot a, Spot b) noexcept {
  const std::int64_t dx = std::int64_t{b.x} - a.x;
  const std::int64_t dy = std::int64_t{b.y} - a.y;
#if IVO_PLANNER_FIXED
  static_assert(kTicksAMetre == 64);
  const auto squared = static_cast<std::uint64_t>(dx * dx + dy * dy);
  if (squared >= std::uint64_t{1} << 36U) {
    return Metres::from_raw(static_cast<std::int64_t>(whole_square_root(squared)) << 14U);
  }
  // The root of a square with 28 bits behind the point has 14: 20 behind the metre's.
  return Metres::from_raw(whole_square_root(squared << 28U));
#else
  return std::sqrt(static_cast<double>(dx * dx + dy * dy)) / kTicksAMetre;
#endif
}

/// Rounded down.
[[nodiscard]] constexpr std::int64_t whole_ticks(Metres length) noexcept {
#if IVO_PLANNER_FIXED
  return length.raw() >> 14U;
#else
  return static_cast<std::int64_t>(length * kTicksAMetre);
#endif
}

[[nodiscard]] constexpr Seconds duration(Metres length, SecondsAMetre pace) noexcept {
#if IVO_PLANNER_FIXED
  return round_to<Seconds>(length * pace);
#else
  return length * pace;
#endif
}

}  // namespace ivo::planner
