// Is this message of a client one at all? Looks at form, order and rate; what it means now is the desk's question.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <variant>

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

/// What a client says.
using ClientMessage = std::variant<Command, AreaCommand, PoseCommand>;

/// One connection's.
class CommandCheck {
 public:
  /// `packet`: what was read of a packet of `size` bytes. When accepted, `message` is it: every field in the range that
  /// console_messages.hpp gives it, numbers finite; whether a mission has that agent, or the map
  /// that place, and whether an area is a simple polygon, is not looked at. A message that is refused leaves the
  /// sequence as it was, but for one that came too often. Cost: a copy.
  [[nodiscard]] Verdict judge(std::span<const std::byte> packet, std::size_t size, RateLimit::Clock::time_point now,
                              ClientMessage& message) noexcept;

 private:
  std::uint32_t last_ = 0;
  RateLimit rate_;
};

/// The sequence number that a refused message claims; 0 when it is too short for one.
[[nodiscard]] std::uint32_t claimed_sequence(std::span<const std::byte> packet) noexcept;

/// These stop the robot, and are never too often.
[[nodiscard]] constexpr bool stops(Kind kind) noexcept { return kind == Kind::kStop || kind == Kind::kPause; }

}  // namespace ivo::firmware::console
