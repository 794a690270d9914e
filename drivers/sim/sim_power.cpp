#include "drivers/sim/sim_power.hpp"

#include "drivers/cia402/controlword.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {

using cia402::PowerState;

namespace {

constexpr std::uint16_t kSwitchOnBit = 0x01;
constexpr std::uint16_t kVoltageBit = 0x02;
constexpr std::uint16_t kQuickStopBit = 0x04;  // active low
constexpr std::uint16_t kEnableBit = 0x08;
constexpr std::uint16_t kHaltBit = 0x100;

}  // namespace

SimMotorAction SimPower::action(const SimOptionCodes& options) const noexcept {
  switch (state_) {
    case PowerState::kOperationEnabled:
      if (leaving_for_.has_value()) {
        return SimMotorAction::kRamp;
      }
      if (halt_) {
        return options.halt == 2 ? SimMotorAction::kQuickRamp : SimMotorAction::kRamp;
      }
      return SimMotorAction::kFollow;
    case PowerState::kQuickStopActive:
      return options.quick_stop == 1 || options.quick_stop == 5 ? SimMotorAction::kRamp : SimMotorAction::kQuickRamp;
    case PowerState::kFaultReactionActive:
      return options.fault_reaction == 1 ? SimMotorAction::kRamp : SimMotorAction::kQuickRamp;
    default:
      return SimMotorAction::kCoast;
  }
}

void SimPower::command(std::uint16_t word, const SimOptionCodes& options) noexcept {
  namespace controlword = cia402::controlword;
  const bool reset_edge = (word & controlword::kFaultReset) != 0 && (last_word_ & controlword::kFaultReset) == 0;
  last_word_ = word;
  halt_ = (word & kHaltBit) != 0;
  if (state_ == PowerState::kFault) {
    state_ = reset_edge ? PowerState::kSwitchOnDisabled : state_;
    return;
  }
  if ((word & kVoltageBit) == 0) {
    disable_voltage();
    return;
  }
  if ((word & kQuickStopBit) == 0) {
    quick_stop(options);
    if (state_ == PowerState::kReadyToSwitchOn || state_ == PowerState::kSwitchedOn) {
      state_ = PowerState::kSwitchOnDisabled;
    }
    return;
  }
  const bool switch_on = (word & kSwitchOnBit) != 0;
  const bool enable = switch_on && (word & kEnableBit) != 0 && !enabling_forbidden_;
  switch (state_) {
    case PowerState::kSwitchOnDisabled:
      state_ = switch_on || !voltage_ ? state_ : PowerState::kReadyToSwitchOn;
      break;
    case PowerState::kReadyToSwitchOn:
    case PowerState::kSwitchedOn:
      state_ = enable      ? PowerState::kOperationEnabled
               : switch_on ? PowerState::kSwitchedOn
                           : PowerState::kReadyToSwitchOn;
      break;
    case PowerState::kOperationEnabled:
      if (enable) {
        leaving_for_.reset();
      } else if (switch_on) {
        leave(PowerState::kSwitchedOn, options.disable == 1);
      } else {
        leave(PowerState::kReadyToSwitchOn, options.shutdown == 1);
      }
      break;
    case PowerState::kQuickStopActive:
      if (enable && options.quick_stop >= cia402::kFirstQuickStopThatStays) {
        state_ = PowerState::kOperationEnabled;  // transition 16
      }
      break;
    case PowerState::kNotReadyToSwitchOn:
    case PowerState::kFaultReactionActive:
    case PowerState::kFault:
    case PowerState::kUnknown:
      break;
  }
}

void SimPower::leave(PowerState goal, bool ramp) noexcept {
  if (ramp) {
    leaving_for_ = goal;
  } else {
    state_ = goal;
    leaving_for_.reset();
  }
}

void SimPower::quick_stop(const SimOptionCodes& options) noexcept {
  if (state_ == PowerState::kOperationEnabled) {
    leaving_for_.reset();
    state_ = options.quick_stop == 0 ? PowerState::kSwitchOnDisabled : PowerState::kQuickStopActive;
  }
}

void SimPower::disable_voltage() noexcept {
  if (state_ != PowerState::kFault && state_ != PowerState::kFaultReactionActive) {
    leaving_for_.reset();
    state_ = PowerState::kSwitchOnDisabled;
  }
}

void SimPower::fault(const SimOptionCodes& options) noexcept {
  if (state_ != PowerState::kFault) {
    leaving_for_.reset();
    state_ = options.fault_reaction == 0 ? PowerState::kFault : PowerState::kFaultReactionActive;
  }
}

void SimPower::at_rest(const SimOptionCodes& options) noexcept {
  if (state_ == PowerState::kFaultReactionActive) {
    state_ = PowerState::kFault;
  } else if (state_ == PowerState::kQuickStopActive && options.quick_stop < cia402::kFirstQuickStopThatStays) {
    state_ = PowerState::kSwitchOnDisabled;
  } else if (state_ == PowerState::kOperationEnabled && leaving_for_.has_value()) {
    state_ = *leaving_for_;
    leaving_for_.reset();
  }
}

void SimPower::set_voltage(bool present) noexcept {
  voltage_ = present;
  if (!present) {
    disable_voltage();
  }
}

void SimPower::forbid_enabling(bool forbidden) noexcept {
  enabling_forbidden_ = forbidden;
  if (forbidden && state_ == PowerState::kOperationEnabled) {
    leave(PowerState::kSwitchedOn, false);
  }
}

void SimPower::reset() noexcept {
  const bool voltage = voltage_;
  const bool forbidden = enabling_forbidden_;
  *this = SimPower();
  voltage_ = voltage;
  enabling_forbidden_ = forbidden;
}

}  // namespace ivo::drivers
