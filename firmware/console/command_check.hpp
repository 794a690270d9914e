// Is this message of a client one at all? Looks at form, order and rate; what it means now is the desk's question.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>

#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::console {

/// So many at once, and so many a second in the long run.
class RateLimit {
 public:
  using Clock = std::chrono::steady_clock;

  /// False: too often. `now` never goes back.
  [[nodiscard]] bool allows(Clock::time_point now) noexcept;

 private:
  static constexpr Clock::duration kOne = std::chrono::nanoseconds(std::chrono::seconds(1)) / kCommandsPerSecond;
  Clock::time_point all_paid_{};  // when what was allowed has been paid for
};

/// One connection's.
class CommandCheck {
 public:
  /// `message`: what was read of a packet of `size` bytes. When accepted, `command` is it. A message that is refused
  /// leaves the sequence as it was, but for one that came too often. Cost: a copy of 24 bytes.
  [[nodiscard]] Verdict judge(std::span<const std::byte> message, std::size_t size, RateLimit::Clock::time_point now,
                              Command& command) noexcept;

 private:
  std::uint32_t last_ = 0;
  RateLimit rate_;
};

/// The sequence number that a refused message claims; 0 when it is too short for one.
[[nodiscard]] std::uint32_t claimed_sequence(std::span<const std::byte> message) noexcept;

}  // namespace ivo::firmware::console
