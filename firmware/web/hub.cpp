#include "firmware/web/hub.hpp"

#include <variant>

#include "firmware/web/page_session.hpp"
#include "firmware/web/ros_connection.hpp"

namespace ivo::firmware::web {
namespace {

std::uint32_t seen_by(const Request& request) {
  const auto* const beat = std::get_if<Beat>(&request);
  const auto* const start = std::get_if<Start>(&request);
  return beat != nullptr ? beat->seen : start != nullptr ? start->seen : 0;
}

}  // namespace

Session& Hub::came(const Paired& paired, bool ros, Instant now) {
  controls_.turn(now);
  const Screen screen = ++last_screen_;
  controls_.came(screen, paired.hash);
  std::unique_ptr<Session>& session = sessions_[screen];
  if (ros) {
    session = std::make_unique<RosConnection>(screen, paired, *this);
  } else {
    session = std::make_unique<PageSession>(screen, paired, *this);
  }
  ros_[screen] = ros;
  ++changes_of_screens_;
  return *session;
}

void Hub::went(Screen screen, Instant now) {
  controls_.turn(now);
  controls_.went(screen, now);
  sessions_.erase(screen);
  ros_.erase(screen);
  ++changes_of_screens_;
}

std::optional<Verdict> Hub::ask(const Session& session, std::uint32_t number, const Request& request, Instant now) {
  const Asker asker{.screen = session.screen(),
                    .owner = session.paired().hash,
                    .may_operate = session.paired().role == Role::kOperator,
                    .fresh = session.fresh(seen_by(request), now)};
  return requests_.ask(asker, number, request, now);
}

std::optional<Verdict> Hub::ask(const Paired& paired, const Request& request, Instant now) {
  controls_.turn(now);
  const Asker asker{.screen = controls_.held_for(paired.hash) ? *controls_.holder() : 0,
                    .owner = paired.hash,
                    .may_operate = paired.role == Role::kOperator,
                    .fresh = false};
  return requests_.ask(asker, 0, request, now);
}

void Hub::show(const Layer& layer) {
  ShownLayer& shown = layers_[static_cast<std::size_t>(layer.name)];
  ++shown.number;
  shown.layer = layer;
}

void Hub::turn(Instant now) {
  link_.turn(now);
  controls_.turn(now);
  published_.update(link_.view());
  for (const Settled& settled : requests_.settled(now)) {
    const auto found = sessions_.find(settled.screen);
    if (found != sessions_.end() && settled.number != 0) {
      found->second->answered(settled.number, settled.verdict);
    }
  }
  say_what_changed();
  if (status_.composed == 0 || now - composed_at_ >= kStatusEvery) {
    compose(now);
  }
}

void Hub::say_what_changed() {
  const bool there = view().link == LinkState::kConnected || view().link == LinkState::kSilent;
  if (view().link != said_link_ && (there || !link_.complaint().empty())) {
    said_link_ = view().link;
    said_(said_link_ == LinkState::kConnected ? "the controller is there"
          : said_link_ == LinkState::kSilent  ? "the controller is silent"
                                              : "no controller: " + link_.complaint());
  }
  if (controls_.holder() != said_holder_) {
    said_holder_ = controls_.holder();
    said_(said_holder_ ? "screen " + std::to_string(*said_holder_) + " holds the controls"
                       : "nobody holds the controls");
  }
}

void Hub::compose(Instant now) {
  composed_at_ = now;
  const Seen seen{.statuses = view().statuses,
                  .link = view().link,
                  .holder = controls_.holder(),
                  .requester = controls_.requester(),
                  .screens = changes_of_screens_,
                  .refusals = refusals_};
  status_.number += status_.composed == 0 || seen != seen_ ? 1 : 0;
  seen_ = seen;
  ++status_.composed;
  Desk desk{.holder = seen.holder, .requester = seen.requester, .screens = {}, .refusals = refusals_};
  for (const auto& [screen, session] : sessions_) {
    desk.screens.push_back({.screen = screen, .name = session->paired().name, .ros = ros_[screen]});
  }
  status_.common = common_status(view(), desk, now);
}

}  // namespace ivo::firmware::web
