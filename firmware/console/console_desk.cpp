#include "firmware/console/console_desk.hpp"

#include <algorithm>
#include <utility>

#include "firmware/loop/loop_status.hpp"

namespace ivo::firmware::console {
namespace {

bool is(const Status& status, Mode mode) { return status.mode == static_cast<std::uint8_t>(mode); }

// A plan may be wanted until the search has ended, but not of a robot in fault.
bool may_plan(const Status& status) {
  const bool running = status.search == static_cast<std::uint8_t>(SearchState::kRunning);
  return running && status.finished == 0 && status.preparing == 0 && !is(status, Mode::kFault) &&
         !is(status, Mode::kStopping) && !is(status, Mode::kDone);
}

}  // namespace

void ConsoleDesk::show(const Status& status, Asks asks) {
  const std::lock_guard lock(mutex_);
  if (plan_wanted()) {
    asks = Asks::kNothing;
  }
  const Asks before = status_.asks;
  const std::uint32_t question = status_.question;
  status_ = status;
  status_.asks = asks;
  status_.question = question;
  status_.areas_revision = board_.revision();
  status_.preparing = plan_wanted() ? 1 : status.preparing;
  if (accepted_plan_ != status.plan_number || status.plan_ready == 0) {
    accepted_plan_.reset();
  }
  status_.accepted = accepted_plan_ ? 1 : 0;
  if (asks == before) {
    return;
  }
  answer_.reset();
  answered_ = false;
  if (asks != Asks::kNothing) {
    ++status_.question;
  }
}

std::optional<DeskAnswer> ConsoleDesk::take(Asks asks) {
  const std::lock_guard lock(mutex_);
  return asks == status_.asks ? std::exchange(answer_, std::nullopt) : std::nullopt;
}

std::vector<DeskRequest> ConsoleDesk::requests() {
  const std::lock_guard lock(mutex_);
  return std::exchange(requests_, {});
}

std::vector<PoseCommand> ConsoleDesk::poses() {
  const std::lock_guard lock(mutex_);
  std::vector<PoseCommand> poses;
  for (std::optional<PoseCommand>& pose : poses_) {
    if (pose) {
      poses.push_back(*pose);
      pose.reset();
    }
  }
  return poses;
}

AreaBoard ConsoleDesk::areas() const {
  const std::lock_guard lock(mutex_);
  return board_;
}

Verdict ConsoleDesk::put(const AreaCommand& area) {
  const std::lock_guard lock(mutex_);
  return board_.put(area);
}

Verdict ConsoleDesk::submit(const ClientMessage& message) {
  return std::visit([this](const auto& word) { return take_word(word); }, message);
}

Verdict ConsoleDesk::take_word(const Command& command) {
  switch (command.header.kind) {
    case Kind::kStop:
      hooks_.stop();
      return Verdict::kAccepted;
    case Kind::kPause:
      nothing_is_agreed();  // first: what was agreed to before is not taken after it
      hooks_.pause();
      return Verdict::kAccepted;
    case Kind::kBeat:
      hooks_.beat();
      return Verdict::kAccepted;
    case Kind::kConsent:
    case Kind::kNoConsent:
    case Kind::kClearFault:
      return answer(command);
    case Kind::kInit:
    case Kind::kReplan:
      return want_plan(command);
    case Kind::kEnough:
    case Kind::kFound:
      return want(command);
    case Kind::kAccept:
      return accept(command);
    case Kind::kRemoveArea: {
      const std::lock_guard lock(mutex_);
      board_.remove(command.argument);
      status_.areas_revision = board_.revision();
      return Verdict::kAccepted;
    }
    default:
      return Verdict::kAccepted;  // a ping
  }
}

Verdict ConsoleDesk::take_word(const AreaCommand& area) {
  const std::lock_guard lock(mutex_);
  const Verdict verdict = board_.put(area);
  status_.areas_revision = board_.revision();
  return verdict;
}

// The newest counts. Of the robot too: others see where it is said to be.
Verdict ConsoleDesk::take_word(const PoseCommand& pose) {
  const std::lock_guard lock(mutex_);
  const bool on_the_map = pose.x_m >= 0 && pose.y_m >= 0 && pose.x_m <= rules_.width_m && pose.y_m <= rules_.height_m;
  if (pose.agent >= rules_.agents || !on_the_map) {
    return Verdict::kOutOfRange;
  }
  if (!reported_[pose.agent]) {
    return Verdict::kNotNow;
  }
  poses_[pose.agent] = pose;
  return Verdict::kAccepted;
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
  if (kind == Kind::kConsent && status_.into_no_go != Status::kNobody) {
    return Verdict::kOutdated;
  }
  // From a page the plan was read and accepted first.
  const bool watched = kind == Kind::kConsent && command.argument == 1;
  if (watched && !accepted_plan_) {
    return Verdict::kNotNow;
  }
  if (std::exchange(answered_, true)) {
    return Verdict::kAnswered;
  }
  answer_ = DeskAnswer{kind, watched};
  return Verdict::kAccepted;
}

// What was agreed to, or may be agreed to now, is void from here on.
Verdict ConsoleDesk::want_plan(const Command& command) {
  const std::lock_guard lock(mutex_);
  if (command.header.kind == Kind::kReplan && command.argument != board_.revision()) {
    return Verdict::kOutdated;
  }
  if (!may_plan(status_) || plan_wanted()) {
    return Verdict::kNotNow;
  }
  const Verdict verdict = keep(command);
  if (verdict == Verdict::kAccepted) {
    status_.preparing = 1;
    status_.asks = Asks::kNothing;
    answer_.reset();
    answered_ = false;
    accepted_plan_.reset();
    status_.accepted = 0;
  }
  return verdict;
}

Verdict ConsoleDesk::want(const Command& command) {
  const std::lock_guard lock(mutex_);
  if (command.header.kind == Kind::kFound) {
    if (command.argument >= status_.agents) {
      return Verdict::kOutOfRange;
    }
    const bool running = status_.search == static_cast<std::uint8_t>(SearchState::kRunning);
    return running && status_.search_started != 0 && status_.finished == 0 ? keep(command) : Verdict::kNotNow;
  }
  if (command.argument != status_.plan_number) {
    return Verdict::kOutdated;
  }
  return is(status_, Mode::kPlanning) && status_.preparing == 0 && status_.horizon_s > 0 ? keep(command)
                                                                                         : Verdict::kNotNow;
}

Verdict ConsoleDesk::accept(const Command& command) {
  const std::lock_guard lock(mutex_);
  if (command.argument != status_.plan_number || status_.into_no_go != Status::kNobody) {
    return Verdict::kOutdated;
  }
  if (status_.plan_ready == 0 || status_.preparing != 0) {
    return Verdict::kNotNow;
  }
  accepted_plan_ = command.argument;
  status_.accepted = 1;
  return Verdict::kAccepted;
}

Verdict ConsoleDesk::keep(const Command& command) {
  if (requests_.size() >= kRequests) {
    return Verdict::kTooOften;
  }
  requests_.push_back({command.header.kind, command.argument});
  return Verdict::kAccepted;
}

void ConsoleDesk::nothing_is_agreed() {
  const std::lock_guard lock(mutex_);
  answer_.reset();
  accepted_plan_.reset();
  status_.accepted = 0;
  if (status_.asks == Asks::kConsent) {  // is asked anew
    status_.asks = Asks::kNothing;
    answered_ = false;
  }
}

bool ConsoleDesk::plan_wanted() const {
  return std::ranges::any_of(requests_, [](const DeskRequest& request) {
    return request.kind == Kind::kInit || request.kind == Kind::kReplan;
  });
}

Status ConsoleDesk::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

}  // namespace ivo::firmware::console
