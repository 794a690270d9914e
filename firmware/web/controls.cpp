#include "firmware/web/controls.hpp"

#include <utility>

namespace ivo::firmware::web {

void Controls::came(Screen screen, const std::string& owner) {
  if (holder_ && gone_at_ && holder_->owner == owner) {
    holder_->screen = screen;
    gone_at_.reset();
  }
}

void Controls::went(Screen screen, Instant now) {
  if (held_by(screen)) {
    gone_at_ = now;
  }
  if (requester_ && requester_->screen == screen) {
    requester_.reset();
  }
}

void Controls::pass_on() {
  holder_ = std::exchange(requester_, std::nullopt);
  gone_at_.reset();
}

void Controls::turn(Instant now) {
  const bool gone = gone_at_ && now - *gone_at_ >= kGone;
  const bool unanswered = requester_ && now - requested_at_ >= kAnswerWithin;
  if (gone || unanswered) {
    pass_on();
  }
}

bool Controls::request(Screen screen, const std::string& owner, Instant now) {
  if (held_by(screen)) {
    return true;
  }
  if (requester_ && requester_->screen != screen) {
    return false;
  }
  if (!requester_) {
    requester_ = Hand{screen, owner};
    requested_at_ = now;
  }
  if (!holder_) {
    pass_on();
  }
  return true;
}

bool Controls::give(Screen screen) {
  const bool may = held_by(screen) && requester_;
  if (may) {
    pass_on();
  }
  return may;
}

bool Controls::keep(Screen screen) {
  const bool may = held_by(screen) && requester_;
  if (may) {
    requester_.reset();
  }
  return may;
}

bool Controls::release(Screen screen) {
  const bool may = held_by(screen);
  if (may) {
    pass_on();
  }
  return may;
}

std::optional<Screen> Controls::holder() const noexcept {
  return holder_ ? std::optional(holder_->screen) : std::nullopt;
}

std::optional<Screen> Controls::requester() const noexcept {
  return requester_ ? std::optional(requester_->screen) : std::nullopt;
}

}  // namespace ivo::firmware::web
