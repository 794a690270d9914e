#include "firmware/web/page_check.hpp"

#include <algorithm>
#include <variant>

namespace ivo::firmware::web {

bool RateLimit::allows(Instant now) noexcept {
  const Instant paid = std::max(all_paid_, now) + one_;
  if (paid > now + most_ * one_) {
    return false;
  }
  all_paid_ = paid;
  return true;
}

PageMessage PageCheck::judge(std::string_view text, Instant now) {
  PageMessage message = page_message(text);
  const std::uint32_t before = last_;
  if (message.sequence != 0 && message.sequence == before + 1) {
    last_ = message.sequence;
  }
  const bool in_time = rate_.allows(now);
  if (message.verdict != Verdict::kAccepted) {
    return message;
  }
  if (message.sequence <= before) {
    message.verdict = Verdict::kReplayed;
  } else if (message.sequence != before + 1) {
    message.verdict = Verdict::kOutOfOrder;
  } else if (!in_time && !std::holds_alternative<Stop>(message.request)) {
    message.verdict = Verdict::kTooOften;
  }
  return message;
}

}  // namespace ivo::firmware::web
