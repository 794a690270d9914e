// A kernel's arrival stamps, on the wall clock, turned into times on the caller's clock, which a set wall clock must
// not move.
#pragma once

#include <algorithm>
#include <cstdint>

#include "config/base/time.hpp"

namespace ivo::hal {

/// A stamp's age by the wall clock, subtracted from now. Both clocks run alike between setting, so the age is right
/// unless the wall clock was set since the stamp; then the result still lies between two calls of begin().
class ArrivalStamps {
 public:
  /// What lies further outside of the two calls than this is the doing of a clock that was set.
  static constexpr Duration kTolerance = std::chrono::milliseconds(1);

  /// Once for each time that the socket is read: `wall_clock` is sampled when `now` is. `backlog`: frames may be older
  /// than the call before.
  void begin(Instant now, Duration wall_clock, bool backlog) noexcept {
    earliest_ = begun_ ? std::min(now_, now) : now;
    now_ = now;
    wall_clock_ = wall_clock;
    backlog_ = backlog;
    begun_ = true;
  }

  /// `stamp` on the wall clock; 0 when there is none, which is now.
  [[nodiscard]] Instant at(Duration stamp) noexcept {
    if (stamp <= Duration::zero()) {
      return now_;
    }
    const Instant arrival = now_ - (wall_clock_ - stamp);
    const bool set_back = arrival > now_ + kTolerance;
    const bool set_forward = arrival < earliest_ - kTolerance && !backlog_;
    clamped_ += set_back || set_forward ? 1 : 0;
    return std::clamp(arrival, earliest_, now_);
  }

  /// Stamps that a set clock had moved.
  [[nodiscard]] std::uint64_t clamped() const noexcept { return clamped_; }

 private:
  Instant earliest_{};
  Instant now_{};
  Duration wall_clock_{};
  std::uint64_t clamped_ = 0;
  bool backlog_ = false;
  bool begun_ = false;
};

}  // namespace ivo::hal
