#include "firmware/web/requests.hpp"

#include <span>
#include <string>
#include <variant>

#include "firmware/console/command_check.hpp"
#include "firmware/web/controller_message.hpp"

namespace ivo::firmware::web {
namespace {

template <class... Requested>
bool is_one_of(const Request& request) {
  return (std::holds_alternative<Requested>(request) || ...);
}

bool is_control(const Request& request) {
  return is_one_of<RequestControl, GiveControl, KeepControl, ReleaseControl>(request);
}

/// Whatever else than looking, stopping and saying what one sees.
bool needs_controls(const Request& request) {
  return !is_one_of<Beat, Stop, Found, Position>(request) && !is_control(request);
}

/// The controller's own, so that it need not refuse it; none: it will not for that.
std::optional<Verdict> verdict_of_content(const Request& request) {
  const std::optional<std::string> packet = controller_message(request, 1);
  console::CommandCheck check;
  console::ClientMessage message;
  const console::Verdict verdict = packet ? check.judge(std::as_bytes(std::span(*packet)), packet->size(), {}, message)
                                          : console::Verdict::kAccepted;
  return verdict == console::Verdict::kAccepted ? std::nullopt : std::optional(verdict_of(verdict));
}

}  // namespace

bool Requests::there() const noexcept {
  return link_.view().link == LinkState::kConnected || link_.view().link == LinkState::kSilent;
}

std::optional<Verdict> Requests::ask(const Asker& asker, std::uint32_t number, const Request& request, Instant now) {
  if (const std::optional<Verdict> verdict = judge(asker, request, now)) {
    if (*verdict != Verdict::kAccepted) {
      refusals_.count(*verdict);
    }
    return verdict;
  }
  // A stop is tried whatever we believe of the controller.
  const bool tried = there() || is_one_of<Stop>(request);
  const std::optional<std::uint32_t> said = tried ? link_.say(request, now) : std::nullopt;
  if (!said) {
    refusals_.count(Verdict::kNoController);
    return Verdict::kNoController;
  }
  pending_[*said] = {.screen = asker.screen, .number = number, .since = now};
  return std::nullopt;
}

std::optional<Verdict> Requests::judge(const Asker& asker, const Request& request, Instant now) {
  controls_.turn(now);
  if (is_control(request)) {
    return control(asker, request, now);
  }
  const bool holds = controls_.held_by(asker.screen);
  if (is_one_of<Beat>(request)) {
    if (!asker.fresh) {
      return Verdict::kNotFresh;
    }
    // Only the operator's keep the robot moving; how often is no page's business.
    const bool passed_on = holds && there() && beats_.allows(now);
    return passed_on ? std::nullopt : std::optional(Verdict::kAccepted);
  }
  if (needs_controls(request) && !(asker.may_operate && holds)) {
    return Verdict::kNotAllowed;
  }
  if (is_one_of<Start>(request) && !asker.fresh) {
    return Verdict::kNotFresh;
  }
  if (is_one_of<Found, Position>(request) && !(asker.may_operate && holds) && !others_.allows(now)) {
    return Verdict::kTooOften;
  }
  return verdict_of_content(request);
}

Verdict Requests::control(const Asker& asker, const Request& request, Instant now) {
  bool done = false;
  if (is_one_of<RequestControl>(request)) {
    done = asker.may_operate && controls_.request(asker.screen, asker.owner, now);
  } else if (is_one_of<GiveControl>(request)) {
    done = controls_.give(asker.screen);
  } else if (is_one_of<KeepControl>(request)) {
    done = controls_.keep(asker.screen);
  } else {
    done = controls_.release(asker.screen);
  }
  return done ? Verdict::kAccepted : Verdict::kNotAllowed;
}

std::vector<Settled> Requests::settled(Instant now) {
  std::vector<Settled> all;
  for (const ControllerLink::Heard& heard : link_.answers()) {
    const auto found = pending_.find(heard.of_sequence);
    if (found == pending_.end()) {
      continue;
    }
    const Verdict verdict = verdict_of(heard.verdict);
    if (verdict != Verdict::kAccepted) {
      refusals_.count_by_controller();
    }
    all.push_back({found->second.screen, found->second.number, verdict});
    pending_.erase(found);
  }
  const bool gone = link_.view().link == LinkState::kAbsent;
  for (auto at = pending_.begin(); at != pending_.end();) {
    if (!gone && now - at->second.since < kPatience) {
      ++at;
      continue;
    }
    refusals_.count(Verdict::kNoController);
    all.push_back({at->second.screen, at->second.number, Verdict::kNoController});
    at = pending_.erase(at);
  }
  return all;
}

}  // namespace ivo::firmware::web
