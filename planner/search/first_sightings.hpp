// When the team first sees each cell, and who: all that an expected time needs for an ideal sensor and a static target
// (Eq. 4 to 8 reduce to it; model.md, "Sensing and expected time").
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/numeric/scalar.hpp"
#include "planner/world/cells.hpp"

namespace ivo::planner {

/// Delta t of Eq. 8.
inline constexpr double kStepSeconds = 1.0;

/// Number of the step, ((k - 1) dt, k dt], that holds `time_s`; 0 from a start. A millionth of a step after its end is
/// still in it: sums of the same durations in another order must not differ. Beyond all that are counted, the last.
[[nodiscard]] inline std::int32_t step_of(double time_s) noexcept {
  constexpr double kLast = std::numeric_limits<std::int32_t>::max() - 1;
  const double steps = std::min(time_s / kStepSeconds - 1e-6, kLast);
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
  std::int32_t step = 0;      ///< k(c)
  std::uint8_t agent = 0;     ///< who saw it at time_s
  std::uint8_t credited = 0;  ///< w of Eq. 5: the lowest-numbered agent that sees it in the step of time_s
};

class FirstSightings {
 public:
  /// Forgets cells `first` to `first + count - 1`. Cost: sixteen bytes a cell.
  void clear(int first, int count) noexcept { std::fill_n(sightings_.begin() + first, count, kUnseen); }
  void clear(int cells) noexcept { clear(0, cells); }

  [[nodiscard]] static bool seen(const Sighting& sighting) noexcept { return sighting.step != kNever; }
  [[nodiscard]] bool seen(Cell c) const noexcept { return seen(of(c)); }
  /// Of a cell that was seen.
  [[nodiscard]] const Sighting& of(Cell c) const noexcept { return sightings_[index(c)]; }
  /// When the credited agent first saw it, in the same step.
  [[nodiscard]] Seconds credited_time_s(Cell c) const noexcept {
    const Sighting& s = of(c);
    return s.agent == s.credited ? s.time_s : credited_time_s_[index(c)];
  }

  /// Takes that `agent` sees `c` at `time_s`. Agents come one after the other, the lowest first, and each in the order
  /// of its times: then the first of two that are equal is the one that counts. True when nobody saw it before.
  bool see(Cell c, int agent, Seconds time_s) noexcept { return see(c, agent, time_s, step_of(time_s)); }
  /// The same for who knows the step of `time_s`.
  bool see(Cell c, int agent, Seconds time_s, std::int32_t step) noexcept {
    Sighting& s = sightings_[index(c)];
    if (step > s.step) {
      return false;
    }
    const auto who = static_cast<std::uint8_t>(agent);
    if (step < s.step) {
      const bool first = s.step == kNever;
      s = {time_s, step, who, who};
      ++taken_;
      return first;
    }
    if (time_s < s.time_s) {
      if (s.agent == s.credited) {
        credited_time_s_[index(c)] = s.time_s;
      }
      s.time_s = time_s;
      s.agent = who;
    }
    return false;
  }

  /// How often see() found a cell new or seen in a later step: the larger part of its work.
  [[nodiscard]] int taken() const noexcept { return taken_; }

 private:
  static constexpr std::int32_t kNever = std::numeric_limits<std::int32_t>::max();
  static constexpr Sighting kUnseen{.time_s = {}, .step = kNever, .agent = 0, .credited = 0};

  int taken_ = 0;
  std::array<Sighting, limits::kCells> sightings_{};
  std::array<Seconds, limits::kCells> credited_time_s_{};
};

}  // namespace ivo::planner
