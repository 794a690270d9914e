#include "drivers/sim/sim_power.hpp"

#include "drivers/cia402/controlword.hpp"

namespace ivo::drivers {

using cia402::PowerState;

void SimPower::command(std::uint16_t word) noexcept {
  namespace controlword = cia402::controlword;
  const bool reset_edge = (word & controlword::kFaultReset) != 0 && (last_word_ & controlword::kFaultReset) == 0;
  last_word_ = word;
  if (state_ == PowerState::kFault) {
    state_ = reset_edge ? PowerState::kSwitchOnDisabled : state_;
    return;
  }
  if ((word & 0x02) == 0) {
    disable_voltage();
    return;
  }
  if ((word & 0x04) == 0) {
    quick_stop();
    if (state_ == PowerState::kReadyToSwitchOn || state_ == PowerState::kSwitchedOn) {
      state_ = PowerState::kSwitchOnDisabled;
    }
    return;
  }
  const bool switch_on = (word & 0x01) != 0;
  const bool enable = switch_on && (word & 0x08) != 0;
  switch (state_) {
    case PowerState::kSwitchOnDisabled:
      state_ = switch_on ? state_ : PowerState::kReadyToSwitchOn;
      break;
    case PowerState::kReadyToSwitchOn:
    case PowerState::kSwitchedOn:
    case PowerState::kOperationEnabled:
      state_ = enable      ? PowerState::kOperationEnabled
               : switch_on ? PowerState::kSwitchedOn
                           : PowerState::kReadyToSwitchOn;
      break;
    case PowerState::kNotReadyToSwitchOn:
    case PowerState::kQuickStopActive:
    case PowerState::kFaultReactionActive:
    case PowerState::kFault:
    case PowerState::kUnknown:
      break;
  }
}

void SimPower::quick_stop() noexcept {
  if (state_ == PowerState::kOperationEnabled) {
    state_ = PowerState::kQuickStopActive;
  }
}

void SimPower::disable_voltage() noexcept {
  if (state_ != PowerState::kFault && state_ != PowerState::kFaultReactionActive) {
    state_ = PowerState::kSwitchOnDisabled;
  }
}

void SimPower::fault() noexcept {
  if (state_ != PowerState::kFault) {
    state_ = PowerState::kFaultReactionActive;
  }
}

void SimPower::at_rest(bool stay) noexcept {
  if (state_ == PowerState::kFaultReactionActive) {
    state_ = PowerState::kFault;
  } else if (state_ == PowerState::kQuickStopActive && !stay) {
    state_ = PowerState::kSwitchOnDisabled;
  }
}

void SimPower::reset() noexcept { *this = SimPower(); }

}  // namespace ivo::drivers
