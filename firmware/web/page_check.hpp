// Does this message of a page come when it may: in order, once, and not too often? One connection's.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "config/base/time.hpp"
#include "firmware/web/page_message.hpp"

namespace ivo::firmware::web {

/// So many at once, and so many a second in the long run.
class RateLimit {
 public:
  explicit RateLimit(int per_second) : one_(Duration(std::chrono::seconds(1)) / per_second), most_(per_second) {}
  /// False: too often. `now` never goes back.
  [[nodiscard]] bool allows(Instant now) noexcept;

 private:
  Duration one_;
  int most_;
  Instant all_paid_{};  // when what was allowed has been paid for
};

class PageCheck {
 public:
  static constexpr int kPerSecond = 40;

  /// The verdict of the whole message. A number counts as used when it was the next, whatever else was wrong: a page
  /// that errs once is not out of order for ever. Stop is never too often.
  [[nodiscard]] PageMessage judge(std::string_view text, Instant now);

 private:
  std::uint32_t last_ = 0;
  RateLimit rate_{kPerSecond};
};

}  // namespace ivo::firmware::web
