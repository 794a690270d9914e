// A held key as a dead-man's switch. A terminal tells no key's release: it repeats the key while it is held, first
// after a pause of a quarter to one second, then some 30 times a second. So held is what is repeated, and silence is
// released.
#pragma once

#include <chrono>
#include <cstdint>

#include "config/base/time.hpp"

namespace ivo::firmware {

/// A press, a pause as a keyboard makes it, two repeats: held. kSilence without a repeat: let go. After that, and after
/// forbid(), keys count again only from a new press that follows kSilence, so a stream of keys that was held up on the
/// way and arrives late, or text that is pasted, moves nothing. Each cycle: update, then press for a key that has come;
/// more of them in one cycle are one, for none of them says how long it was on its way. Time never goes back.
class DeadMan {
 public:
  static constexpr Duration kSilence = std::chrono::milliseconds(150);
  static constexpr Duration kShortestPause = std::chrono::milliseconds(150);  ///< from press to first repeat
  static constexpr Duration kLongestPause = std::chrono::milliseconds(1200);

  enum class State : std::uint8_t {
    kReleased,
    kPressed,    ///< one press, which may yet be no more than a tap
    kRepeating,  ///< the first repeat
    kHeld,
    kForbidden,  ///< keys come that are no new press
  };

  void update(Instant now) noexcept;
  void press(Instant now) noexcept;
  /// What is held now no longer counts: let go first.
  void forbid() noexcept { state_ = state_ == State::kReleased ? state_ : State::kForbidden; }

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] bool held() const noexcept { return state_ == State::kHeld; }
  /// A key is down and may become, or is, held.
  [[nodiscard]] bool touched() const noexcept { return state_ != State::kReleased && state_ != State::kForbidden; }

 private:
  State state_ = State::kReleased;
  Instant last_{};  // key
};

}  // namespace ivo::firmware
