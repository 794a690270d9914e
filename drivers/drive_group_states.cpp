// What the group makes of what the drives say: from state to state, and into kFault.
#include <algorithm>

#include "drivers/drive_group.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;

PowerState step_before(PowerState step) noexcept {
  return step == PowerState::kOperationEnabled ? PowerState::kSwitchedOn : PowerState::kReadyToSwitchOn;
}

PowerState next_step(PowerState step) noexcept {
  return step == PowerState::kReadyToSwitchOn ? PowerState::kSwitchedOn : PowerState::kOperationEnabled;
}

}  // namespace

const GroupFeedback& DriveGroup::update(Instant now) noexcept {
  for (WheelDrive& drive : drives_) {
    drive.update(now);
  }
  watch_.update(bus_, synchronous_);
  collect();
  if (!resetting_) {
    latch_first(DriveFaultReason::kDriveInFault, &WheelDrive::in_fault);
  }
  switch (state_) {
    case GroupState::kBooting:
      update_booting(now);
      break;
    case GroupState::kReady:
      watch_unasked_power(now);
      break;
    case GroupState::kEnabling:
      update_enabling(now);
      break;
    case GroupState::kEnabled:
      latch_first(DriveFaultReason::kLeftOperationEnabled,
                  [](const WheelDrive& drive) { return drive.power_state() != PowerState::kOperationEnabled; });
      break;
    case GroupState::kStopping:
      update_stopping(now);
      break;
    case GroupState::kFault:
      update_fault(now);
      break;
  }
  find_fault(now);
  feedback_.state = state_;
  feedback_.off = may_end(now);
  return feedback_;
}

void DriveGroup::collect() noexcept {
  feedback_.fresh = synchronous_;
  bool still = true;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    feedback_.angle_rad[i] = drives_[i].encoder().angle_rad();
    feedback_.radps[i] = drives_[i].encoder().radps();
    feedback_.fresh = feedback_.fresh && drives_[i].fresh();
    still = still && drives_[i].encoder().still();
  }
  feedback_.standstill = feedback_.fresh && still;
}

template <class Condition>
void DriveGroup::latch_first(DriveFaultReason reason, const Condition& at_fault) noexcept {
  const auto drive = std::ranges::find_if(drives_, at_fault);
  if (drive != drives_.end()) {
    drive->latch(reason, drive->statusword());
  }
}

void DriveGroup::find_fault(Instant now) noexcept {
  if (state_ == GroupState::kFault && !resetting_) {
    return;
  }
  if (const DriveFault fault = first_fault(); fault.reason != DriveFaultReason::kNone) {
    enter_fault(fault, now);
  }
}

DriveFault DriveGroup::first_fault() const noexcept {
  if (watch_.fault().reason != DriveFaultReason::kNone) {
    return watch_.fault();
  }
  if (unsent_writes_ == kUnsentWrites) {
    return {.reason = DriveFaultReason::kCommandsNotSent};
  }
  const auto faulty = std::find_if(drives_.begin(), drives_.end(), [](const WheelDrive& drive) {
    return drive.fault().reason != DriveFaultReason::kNone;
  });
  return faulty == drives_.end() ? DriveFault{} : faulty->fault();
}

void DriveGroup::enter_fault(const DriveFault& fault, Instant now) noexcept {
  if (state_ != GroupState::kFault && state_ != GroupState::kStopping) {
    begin_quick_stop(now);
    quick_stop_judged_ = state_ != GroupState::kEnabling && state_ != GroupState::kEnabled;  // without power: coasting
  }
  feedback_.fault = fault;
  enter(GroupState::kFault, now);
  enable_was_false_ = false;
  reset_asked_ = false;
  resetting_ = false;
}

void DriveGroup::update_booting(Instant now) noexcept {
  const auto all_reached = [this](WheelDrive::Phase phase) {
    return std::all_of(drives_.begin(), drives_.end(),
                       [phase](const WheelDrive& drive) { return drive.phase() == phase; });
  };
  if (all_reached(WheelDrive::Phase::kConfigured)) {
    for (WheelDrive& drive : drives_) {
      drive.start();
    }
  } else if (all_reached(WheelDrive::Phase::kOperational)) {
    synchronous_ = true;
    enter(GroupState::kReady, now);
  }
}

void DriveGroup::watch_unasked_power(Instant now) noexcept {
  if (std::ranges::none_of(drives_, &WheelDrive::powered)) {
    powered_since_.reset();
    return;
  }
  powered_since_ = powered_since_.value_or(now);
  if (now - *powered_since_ >= rates::kUnaskedPowerTimeout) {
    latch_first(DriveFaultReason::kUnaskedState, &WheelDrive::powered);
  }
}

void DriveGroup::update_enabling(Instant now) noexcept {
  const auto elsewhere = [this](const WheelDrive& drive) { return drive.power_state() != step_; };
  if (feedback_.fresh && std::none_of(drives_.begin(), drives_.end(), elsewhere)) {
    const bool last = step_ == PowerState::kOperationEnabled;
    enter(last ? GroupState::kEnabled : GroupState::kEnabling, now);
    step_ = next_step(step_);
    return;
  }
  latch_first(DriveFaultReason::kUnaskedState, [this](const WheelDrive& drive) {
    const bool first = step_ == PowerState::kReadyToSwitchOn;
    const PowerState state = drive.power_state();
    return first ? drive.powered() : state != step_ && state != step_before(step_);
  });
  if (now - since_ > rates::kStateChangeTimeout) {
    latch_first(DriveFaultReason::kVoltageMissing, [this, elsewhere](const WheelDrive& drive) {
      return elsewhere(drive) && drive.power_state() == PowerState::kSwitchOnDisabled;
    });
    latch_first(DriveFaultReason::kStateChangeTimedOut, elsewhere);
  }
}

void DriveGroup::update_stopping(Instant now) noexcept {
  const Duration passed = now - since_;
  if (feedback_.standstill && all_off()) {
    enter(GroupState::kReady, now);
  } else if (passed > rates::kStandstillTimeout && !feedback_.standstill) {
    latch_first(DriveFaultReason::kNotStill, [](const WheelDrive& drive) { return !drive.encoder().still(); });
  } else if (passed > rates::kStandstillTimeout + rates::kStateChangeTimeout) {
    latch_first(DriveFaultReason::kStateChangeTimedOut, [](const WheelDrive& drive) { return !drive.off(); });
  }
}

void DriveGroup::update_fault(Instant now) noexcept {
  if (resetting_) {
    update_resetting(now);
    return;
  }
  judge_quick_stop(now);
  // A reset takes the quick stop away: it waits until the wheels rest or the quick stop had its time.
  const bool at_rest = !synchronous_ || quick_stop_over(now);
  if (!reset_asked_ || !at_rest) {
    return;
  }
  reset_asked_ = false;
  if (!may_reset(now)) {
    feedback_.fault.reason = DriveFaultReason::kResetLimit;
    feedback_.fault.code = rates::kResetLimit;
    return;
  }
  const bool anew = std::any_of(drives_.begin(), drives_.end(), [](const WheelDrive& drive) {
    return !drive.operational() || needs_start_up(drive.fault());
  });
  if (anew || needs_start_up(feedback_.fault)) {
    open(now);
    return;
  }
  for (WheelDrive& drive : drives_) {
    drive.clear_fault();
  }
  resetting_ = true;
  since_ = now;
}

// Who has come to rest has stopped, and may be pushed afterwards.
void DriveGroup::judge_quick_stop(Instant now) noexcept {
  if (quick_stop_judged_ || !synchronous_) {
    return;
  }
  const auto turning = std::ranges::find_if(
      drives_, [now](const WheelDrive& drive) { return drive.answers(now) && !drive.encoder().still(); });
  const bool over = now - quick_stop_since_ > rates::kStandstillTimeout;
  quick_stop_judged_ = over || turning == drives_.end();
  if (over && turning != drives_.end() && feedback_.fault.reason != DriveFaultReason::kNotStill) {
    feedback_.fault.turning_node_id = turning->node_id();
    feedback_.fault.turning_wheel = static_cast<Wheel>(turning - drives_.begin());
  }
}

bool DriveGroup::may_reset(Instant now) noexcept {
  std::optional<Instant>& oldest = resets_[next_reset_];
  if (oldest.has_value() && now - *oldest < rates::kResetWindow) {
    return false;
  }
  oldest = now;
  next_reset_ = (next_reset_ + 1) % resets_.size();
  return true;
}

void DriveGroup::update_resetting(Instant now) noexcept {
  if (feedback_.fresh && all_off()) {
    resetting_ = false;
    voltage_off_ = true;
    feedback_.fault = {};
    enter(GroupState::kReady, now);
  } else if (now - since_ > rates::kStateChangeTimeout) {
    latch_first(DriveFaultReason::kFaultResetFailed, [](const WheelDrive& drive) { return !drive.off(); });
  }
}

}  // namespace ivo::drivers
