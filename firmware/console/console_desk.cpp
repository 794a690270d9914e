#include "firmware/console/console_desk.hpp"

#include <utility>

namespace ivo::firmware::console {

void ConsoleDesk::show(const Status& status, Asks asks) {
  const std::lock_guard lock(mutex_);
  const Asks before = status_.asks;
  const std::uint32_t question = status_.question;
  status_ = status;
  status_.asks = asks;
  status_.question = question;
  if (asks == before) {
    return;
  }
  answer_.reset();
  answered_ = false;
  if (asks != Asks::kNothing) {
    ++status_.question;
  }
}

std::optional<Kind> ConsoleDesk::take(Asks asks) {
  const std::lock_guard lock(mutex_);
  return asks == status_.asks ? std::exchange(answer_, std::nullopt) : std::nullopt;
}

Verdict ConsoleDesk::submit(const ClientMessage& message) {
  const Command* const said = std::get_if<Command>(&message);
  if (said == nullptr) {
    return Verdict::kNotNow;
  }
  const Command& command = *said;
  switch (command.header.kind) {
    case Kind::kStop:
      stop_();
      return Verdict::kAccepted;
    case Kind::kConsent:
    case Kind::kNoConsent:
    case Kind::kClearFault:
      return answer(command);
    default:
      return Verdict::kAccepted;  // a ping
  }
}

Verdict ConsoleDesk::answer(const Command& command) {
  const std::lock_guard lock(mutex_);
  const Kind kind = command.header.kind;
  const bool fits = (status_.asks == Asks::kConsent && kind == Kind::kConsent) ||
                    (status_.asks == Asks::kClearing && kind == Kind::kClearFault) ||
                    (status_.asks != Asks::kNothing && kind == Kind::kNoConsent);
  if (!fits) {
    return Verdict::kNotAsked;
  }
  if (command.question != status_.question) {
    return Verdict::kOtherQuestion;
  }
  if (std::exchange(answered_, true)) {
    return Verdict::kAnswered;
  }
  answer_ = kind;
  return Verdict::kAccepted;
}

Status ConsoleDesk::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

}  // namespace ivo::firmware::console
