// Time as the loop sees it: nanoseconds on one clock that the program is given.
#pragma once

#include <chrono>

namespace ivo {

using Duration = std::chrono::nanoseconds;

/// Tag of the loop's clock. It has no now(): time is handed in, by hal/api/clock.hpp.
struct LoopClock {
  using rep = Duration::rep;
  using period = Duration::period;
  using duration = Duration;
  using time_point = std::chrono::time_point<LoopClock>;
  static constexpr bool is_steady = true;
};

using Instant = LoopClock::time_point;

/// Seconds as a number, for arithmetic at the edge of a formula and for files.
[[nodiscard]] constexpr double seconds(Duration d) noexcept { return std::chrono::duration<double>(d).count(); }

/// As people read a delay in a report.
[[nodiscard]] constexpr double microseconds(Duration d) noexcept { return static_cast<double>(d.count()) / 1e3; }

/// The nearest whole nanosecond to `s` seconds.
[[nodiscard]] constexpr Duration from_seconds(double s) noexcept {
  return Duration(static_cast<Duration::rep>(s * 1e9 + (s < 0 ? -0.5 : 0.5)));
}

}  // namespace ivo
