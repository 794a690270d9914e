#include "firmware/tools/wheels/dead_man.hpp"

namespace ivo::firmware {

void DeadMan::update(Instant now) noexcept {
  const Duration patience = state_ == State::kPressed ? kLongestPause : kSilence;
  if (now - last_ > patience) {
    state_ = State::kReleased;
  }
}

void DeadMan::press(Instant now) noexcept {
  const Duration pause = now - last_;
  last_ = now;
  switch (state_) {
    case State::kReleased:
      state_ = State::kPressed;
      break;
    case State::kPressed:
      state_ = pause >= kShortestPause ? State::kRepeating : State::kForbidden;
      break;
    case State::kRepeating:
      state_ = State::kHeld;
      break;
    case State::kHeld:
    case State::kForbidden:
      break;
  }
}

}  // namespace ivo::firmware
