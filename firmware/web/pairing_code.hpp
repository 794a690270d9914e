// The six digits with which a screen proves that somebody stands at the robot.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "config/base/time.hpp"
#include "firmware/web/client_address.hpp"
#include "firmware/web/random.hpp"

namespace ivo::firmware::web {

/// Whoever guesses locks himself out, and nobody else: tries are counted by address. Of many addresses together so few
/// guesses an hour are looked at that none is likely to be right.
class PairingCode {
 public:
  static constexpr int kTries = 5;
  static constexpr Duration kLocked = std::chrono::seconds(30);  ///< the first time; then twice as long each time
  static constexpr Duration kLongestLocked = std::chrono::minutes(15);
  static constexpr std::size_t kAddresses = 64;  ///< remembered; whose last wrong one is oldest is forgotten
  static constexpr Duration kSpan = std::chrono::hours(1);
  static constexpr int kWrongOfAll = 100;  ///< within kSpan

  struct Right {};
  struct Wrong {
    int left = 0;  ///< tries
  };
  /// For that address.
  struct Locked {
    int wait_s = 0;     ///< until the next try is looked at
    bool anew = false;  ///< with this try
  };
  /// For everybody but this machine itself.
  struct Closed {
    int wait_s = 0;
    bool anew = false;
  };
  using Outcome = std::variant<Right, Wrong, Locked, Closed>;

  explicit PairingCode(RandomSource random = random_bytes);

  /// A right one counts once: then there is a new code, as there is when pairing is closed.
  [[nodiscard]] Outcome test(const std::string& code, const ClientAddress& from, Instant now);
  [[nodiscard]] const std::string& digits() const noexcept { return digits_; }

 private:
  struct Guesser {
    std::string address;
    int left = kTries;
    Duration next_lock = kLocked;
    Instant locked_until{};
    Instant wrong_at{};
  };

  void renew();
  [[nodiscard]] Guesser& guesser(const std::string& address, Instant now);

  RandomSource random_;
  std::string digits_;
  std::vector<Guesser> guessers_;  // whose last wrong one is oldest first
  Instant span_begin_{};
  int wrong_of_all_ = 0;  // in this span
};

}  // namespace ivo::firmware::web
