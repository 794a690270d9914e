#include "firmware/web/pairing_code.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace ivo::firmware::web {
namespace {

int whole_seconds(Duration span) { return static_cast<int>(std::chrono::ceil<std::chrono::seconds>(span).count()); }

}  // namespace

PairingCode::PairingCode(RandomSource random) : random_(std::move(random)) { renew(); }

void PairingCode::renew() {
  constexpr std::uint64_t kCodes = 1'000'000;
  std::uint64_t number = 0;  // of 64 bits: the last digits of so many are as good as even
  const std::string bytes = random_(sizeof(number));
  std::memcpy(&number, bytes.data(), sizeof(number));
  const std::string digits = std::to_string(kCodes + number % kCodes);
  digits_ = digits.substr(1);
}

PairingCode::Guesser& PairingCode::guesser(const std::string& address, Instant now) {
  auto found = std::find_if(guessers_.begin(), guessers_.end(), [&](const Guesser& g) { return g.address == address; });
  if (found == guessers_.end()) {
    if (guessers_.size() >= kAddresses) {
      guessers_.erase(guessers_.begin());
    }
    guessers_.push_back({.address = address});
  } else {
    std::rotate(found, found + 1, guessers_.end());
  }
  Guesser& last = guessers_.back();
  last.wrong_at = now;
  return last;
}

PairingCode::Outcome PairingCode::test(const std::string& code, const ClientAddress& from, Instant now) {
  std::erase_if(guessers_, [&](const Guesser& g) { return now - g.wrong_at >= kSpan; });
  if (now - span_begin_ >= kSpan) {
    wrong_of_all_ = 0;
  }
  const auto known =
      std::find_if(guessers_.begin(), guessers_.end(), [&](const Guesser& g) { return g.address == from.group; });
  if (known != guessers_.end() && now < known->locked_until) {
    return Locked{.wait_s = whole_seconds(known->locked_until - now), .anew = false};
  }
  if (!from.this_machine && wrong_of_all_ >= kWrongOfAll) {
    return Closed{.wait_s = whole_seconds(span_begin_ + kSpan - now), .anew = false};
  }
  if (same_secret(code, digits_)) {
    if (known != guessers_.end()) {
      guessers_.erase(known);
    }
    renew();
    return Right{};
  }
  Guesser& who = guesser(from.group, now);
  const bool locks = --who.left == 0;
  if (locks) {
    who.left = kTries;
    who.locked_until = now + who.next_lock;
    who.next_lock = std::min(2 * who.next_lock, kLongestLocked);
  }
  if (!from.this_machine) {
    span_begin_ = wrong_of_all_ == 0 ? now : span_begin_;
    if (++wrong_of_all_ == kWrongOfAll) {
      renew();
      return Closed{.wait_s = whole_seconds(span_begin_ + kSpan - now), .anew = true};
    }
  }
  return locks ? Outcome(Locked{.wait_s = whole_seconds(who.locked_until - now), .anew = true})
               : Outcome(Wrong{who.left});
}

}  // namespace ivo::firmware::web
