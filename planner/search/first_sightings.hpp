// When the team first sees each cell, and who: all that an expected time needs for an ideal sensor and a static target
// (Eq. 4 to 8 reduce to it; model.md, "Sensing and expected time").
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/numeric/scalar.hpp"
#include "planner/world/cells.hpp"

namespace ivo::planner {

/// Delta t of Eq. 8.
inline constexpr double kStepSeconds = 1.0;

/// Number of the step, ((k - 1) dt, k dt], that holds `time_s`; 0 from a start. A millionth of a step after its end is
/// still in it: sums of the same durations in another order must not differ.
[[nodiscard]] inline std::int32_t step_of(double time_s) noexcept {
  const double steps = time_s / kStepSeconds - 1e-6;
  const auto whole = static_cast<std::int32_t>(steps);
  return steps <= 0.0 ? 0 : whole + (whole < steps ? 1 : 0);
}
/// In fixed point, two units of resolution after its end.
[[nodiscard]] constexpr std::int32_t step_of(Fixed<16> time_s) noexcept {
  const Fixed<16> rounded = time_s + Fixed<16>::from_raw((1 << 16) - 1 - 2);
  return rounded.raw() <= 0 ? 0 : rounded.floor();
}

struct Sighting {
  Seconds time_s{};           ///< t_c: first seen by anybody
  Seconds credited_time_s{};  ///< first seen by the credited agent, in the same step
  std::uint8_t agent = 0;     ///< who saw it at time_s
  std::uint8_t credited = 0;  ///< w of Eq. 5: the lowest-numbered agent that sees it in the step of time_s
  std::int32_t step = 0;      ///< k(c)
};

class FirstSightings {
 public:
  /// Forgets cells `first` to `first + count - 1`. Cost: eight bytes a cell.
  void clear(int first, int count) noexcept { std::fill_n(until_s_.begin() + first, count, kNever); }
  void clear(int cells) noexcept { clear(0, cells); }

  [[nodiscard]] bool seen(Cell c) const noexcept { return until_s_[index(c)] != kNever; }
  /// Of a cell that was seen.
  [[nodiscard]] const Sighting& of(Cell c) const noexcept { return sightings_[index(c)]; }

  /// Takes that `agent` sees `c` at `time_s`. Agents come one after the other, the lowest first, and each in the order
  /// of its times: then the first of two that are equal is the one that counts. True when nobody saw it before.
  bool see(Cell c, int agent, Seconds time_s) noexcept {
    return time_s < until_s_[index(c)] && take(c, static_cast<std::uint8_t>(agent), time_s);
  }

  /// How often see() had to look closer: the larger part of its work.
  [[nodiscard]] int taken() const noexcept { return taken_; }

 private:
#if IVO_PLANNER_FIXED
  static constexpr Seconds kNever = Seconds::from_raw(std::int64_t{1} << 62);
#else
  static constexpr Seconds kNever = 1e300;
#endif

  bool take(Cell c, std::uint8_t who, Seconds time_s) noexcept {
    Seconds& until_s = until_s_[index(c)];
    Sighting& s = sightings_[index(c)];
    ++taken_;
    const std::int32_t step = step_of(time_s);
    const bool first = until_s == kNever;
    if (!first && step > s.step) {
      return false;
    }
    if (first || step < s.step) {
      s.credited = who;
      s.credited_time_s = time_s;
      s.step = step;
      until_s = Seconds(step) + Seconds(1e-3);  // later than this it is another step; the step itself decides
    }
    if (first || time_s < s.time_s) {
      s.time_s = time_s;
      s.agent = who;
    }
    return first;
  }

  int taken_ = 0;
  std::array<Seconds, limits::kCells> until_s_{};
  std::array<Sighting, limits::kCells> sightings_{};
};

}  // namespace ivo::planner
