// When the team first sees each cell, and who: all that an expected time needs for an ideal sensor and a static target
// (Eq. 4 to 8 reduce to it; model.md, "Sensing and expected time").
#pragma once

#include <array>
#include <cstdint>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/world/cells.hpp"

namespace ivo::planner {

/// Delta t of Eq. 8.
inline constexpr double kStepSeconds = 1.0;

/// Number of the step, ((k - 1) dt, k dt], that holds `time_s`; 0 from a start.
[[nodiscard]] inline std::int32_t step_of(double time_s) noexcept {
  const double steps = time_s / kStepSeconds - 1e-6;
  const auto whole = static_cast<std::int32_t>(steps);
  return steps <= 0.0 ? 0 : whole + (whole < steps ? 1 : 0);
}

struct Sighting {
  double time_s = 0.0;           ///< t_c: first seen by anybody
  double credited_time_s = 0.0;  ///< first seen by the credited agent, in the same step
  std::uint8_t agent = 0;        ///< who saw it at time_s
  std::uint8_t credited = 0;     ///< w of Eq. 5: the lowest-numbered agent that sees it in the step of time_s
};

class FirstSightings {
 public:
  /// Forgets everything. Cost: constant, but once in 2^32 calls.
  void clear() noexcept {
    if (++epoch_ == 0) {
      entries_.fill({});
      epoch_ = 1;
    }
  }

  [[nodiscard]] bool seen(Cell c) const noexcept { return entries_[index(c)].epoch == epoch_; }
  /// Of a cell that was seen.
  [[nodiscard]] const Sighting& of(Cell c) const noexcept { return entries_[index(c)].sighting; }

  /// Takes that `agent` sees `c` at `time_s`, in any order of times and agents. True when nobody saw it before.
  bool see(Cell c, int agent, double time_s) noexcept {
    Entry& entry = entries_[index(c)];
    Sighting& s = entry.sighting;
    const auto who = static_cast<std::uint8_t>(agent);
    if (entry.epoch != epoch_) {
      entry = {{time_s, time_s, who, who}, epoch_};
      return true;
    }
    if (time_s < s.time_s || s.credited > who || (s.credited == who && time_s < s.credited_time_s)) {
      merge(s, who, time_s);
    }
    return false;
  }

 private:
  struct Entry {
    Sighting sighting;
    std::uint32_t epoch = 0;  // the sighting counts when it is the present one
  };

  static void merge(Sighting& s, std::uint8_t who, double time_s) noexcept {
    const std::int32_t step = step_of(time_s);
    const std::int32_t known = step_of(s.time_s);
    if (step > known) {
      return;
    }
    if (step < known || who < s.credited || (who == s.credited && time_s < s.credited_time_s)) {
      s.credited = who;
      s.credited_time_s = time_s;
    }
    if (time_s < s.time_s || (time_s == s.time_s && who < s.agent)) {
      s.time_s = time_s;
      s.agent = who;
    }
  }

  std::uint32_t epoch_ = 0;
  std::array<Entry, limits::kCells> entries_{};
};

}  // namespace ivo::planner
