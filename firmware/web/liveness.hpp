// Is the link of who would set the robot off good enough: both ways, within the last second?
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "config/base/time.hpp"

namespace ivo::firmware::web {

/// One connection's. What is said to it is numbered, and it names in what it says the newest of these that it has
/// heard: that something arrives now does not say when it set out.
class Liveness {
 public:
  static constexpr Duration kFresh = std::chrono::seconds(1);

  /// Number `number` has been written to it to its last byte; numbers grow.
  void told(std::uint32_t number, Instant now) {
    while (!told_.empty() && now - told_.front().at > kFresh) {
      told_.pop_front();
    }
    told_.push_back({number, now});
  }
  /// What it says with that number set out within the last second.
  [[nodiscard]] bool is_new(std::uint32_t number, Instant now) const noexcept {
    for (const Told& told : told_) {
      if (told.number == number) {
        return now - told.at <= kFresh;
      }
    }
    return false;
  }
  /// It has said that it is there. False: that is old, and counts for nothing.
  bool beat(std::uint32_t number, Instant now) noexcept {
    if (is_new(number, now)) {
      beat_ = now;
      return true;
    }
    return false;
  }
  [[nodiscard]] bool beats(Instant now) const noexcept { return beat_ && now - *beat_ <= kFresh; }

 private:
  struct Told {
    std::uint32_t number = 0;
    Instant at{};
  };

  std::deque<Told> told_;  // within the last second
  std::optional<Instant> beat_;
};

}  // namespace ivo::firmware::web
