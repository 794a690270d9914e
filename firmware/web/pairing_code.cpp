#include "firmware/web/pairing_code.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

namespace ivo::firmware::web {

PairingCode::PairingCode(RandomSource random) : random_(std::move(random)) { renew(); }

void PairingCode::renew() {
  constexpr std::uint64_t kCodes = 1'000'000;
  std::uint64_t number = 0;  // of 64 bits: the last digits of so many are as good as even
  const std::string bytes = random_(sizeof(number));
  std::memcpy(&number, bytes.data(), sizeof(number));
  const std::string digits = std::to_string(kCodes + number % kCodes);
  digits_ = digits.substr(1);
  left_ = kTries;
}

PairingCode::Outcome PairingCode::test(const std::string& code, Instant now) {
  if (now < locked_until_) {
    return Locked{static_cast<int>(std::chrono::ceil<std::chrono::seconds>(locked_until_ - now).count())};
  }
  if (same_secret(code, digits_)) {
    renew();
    return Right{};
  }
  if (--left_ > 0) {
    return Wrong{left_};
  }
  locked_until_ = now + kLocked;
  renew();
  return Locked{static_cast<int>(std::chrono::ceil<std::chrono::seconds>(kLocked).count())};
}

}  // namespace ivo::firmware::web
