// Who holds the controls: one screen at a time, which gives them away or is asked for them.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "config/base/time.hpp"

namespace ivo::firmware::web {

/// The number of a connection, from 1.
using Screen = std::uint32_t;

class Controls {
 public:
  static constexpr Duration kAnswerWithin = std::chrono::seconds(10);  ///< or they are given to who asks
  static constexpr Duration kGone = std::chrono::seconds(2);           ///< then nobody holds them

  /// `owner`: whose screen it is. A holder who comes back in time, by a reload say, holds them still.
  void came(Screen screen, const std::string& owner);
  void went(Screen screen, Instant now);
  /// What time alone decides. Called before each of those below, and often.
  void turn(Instant now);

  /// Given at once when nobody holds them. False: another one waits for them already.
  [[nodiscard]] bool request(Screen screen, const std::string& owner, Instant now);
  // False: it does not hold them, or nobody has asked.
  [[nodiscard]] bool give(Screen screen);
  [[nodiscard]] bool keep(Screen screen);
  [[nodiscard]] bool release(Screen screen);

  [[nodiscard]] bool held_by(Screen screen) const noexcept { return holder_ && holder_->screen == screen; }
  /// By a screen of that owner, which is there.
  [[nodiscard]] bool held_for(const std::string& owner) const noexcept {
    return holder_ && !gone_at_ && holder_->owner == owner;
  }
  [[nodiscard]] std::optional<Screen> holder() const noexcept;
  [[nodiscard]] std::optional<Screen> requester() const noexcept;

 private:
  struct Hand {
    Screen screen = 0;
    std::string owner;
  };

  void pass_on();

  std::optional<Hand> holder_;
  std::optional<Instant> gone_at_;  // of the holder
  std::optional<Hand> requester_;
  Instant requested_at_{};
};

}  // namespace ivo::firmware::web
