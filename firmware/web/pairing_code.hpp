// The six digits with which a screen proves that somebody stands at the robot.
#pragma once

#include <chrono>
#include <string>
#include <variant>

#include "config/base/time.hpp"
#include "firmware/web/random.hpp"

namespace ivo::firmware::web {

class PairingCode {
 public:
  static constexpr int kTries = 5;
  static constexpr Duration kLocked = std::chrono::seconds(30);

  struct Right {};
  struct Wrong {
    int left = 0;  ///< tries
  };
  struct Locked {
    int wait_s = 0;  ///< until the next try is looked at
  };
  using Outcome = std::variant<Right, Wrong, Locked>;

  explicit PairingCode(RandomSource random = random_bytes);

  /// A right one counts once: then there is a new code. The fifth wrong one in a row makes a new code too, and nothing
  /// is looked at for half a minute.
  [[nodiscard]] Outcome test(const std::string& code, Instant now);
  [[nodiscard]] const std::string& digits() const noexcept { return digits_; }

 private:
  void renew();

  RandomSource random_;
  std::string digits_;
  int left_ = kTries;
  Instant locked_until_{};
};

}  // namespace ivo::firmware::web
