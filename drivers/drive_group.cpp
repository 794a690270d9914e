#include "drivers/drive_group.hpp"

#include <algorithm>

#include "config/base/contract.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/sync.hpp"
#include "drivers/cia402/controlword.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;
namespace controlword = cia402::controlword;

WheelDrive make_drive(const Robot& robot, Wheel wheel) noexcept {
  return {robot.drives[static_cast<std::size_t>(wheel)], wheel, robot.master_node_id};
}

bool in_fault(const WheelDrive& drive) noexcept {
  const PowerState state = drive.power_state();
  return state == PowerState::kFault || state == PowerState::kFaultReactionActive;
}

bool is_off(const WheelDrive& drive) noexcept {
  const PowerState state = drive.power_state();
  return state == PowerState::kNotReadyToSwitchOn || state == PowerState::kSwitchOnDisabled ||
         state == PowerState::kReadyToSwitchOn;
}

PowerState next_step(PowerState step) noexcept {
  return step == PowerState::kReadyToSwitchOn ? PowerState::kSwitchedOn : PowerState::kOperationEnabled;
}

}  // namespace

DriveGroup::DriveGroup(hal::CanBus& bus, const Robot& robot) noexcept
    : bus_(bus),
      drives_{make_drive(robot, Wheel::kFrontLeft), make_drive(robot, Wheel::kFrontRight),
              make_drive(robot, Wheel::kRearLeft), make_drive(robot, Wheel::kRearRight)},
      master_node_id_(robot.master_node_id) {}

void DriveGroup::open(Instant now) noexcept {
  for (WheelDrive& drive : drives_) {
    drive.open();
  }
  enter(GroupState::kBooting, now);
  synchronous_ = false;
  enable_was_false_ = false;
  voltage_off_ = true;
  reset_asked_ = false;
  resetting_ = false;
  feedback_.fault = {};
}

void DriveGroup::on_frame(const hal::CanFrame& frame) noexcept {
  for (WheelDrive& drive : drives_) {
    if (drive.node_id() == cob_id::node_of(frame.id)) {
      drive.on_frame(frame);
      return;
    }
  }
}

const GroupFeedback& DriveGroup::update(Instant now) noexcept {
  for (WheelDrive& drive : drives_) {
    drive.update(now);
  }
  collect();
  if (!resetting_) {
    latch_first(DriveFaultReason::kDriveInFault, in_fault);
  }
  switch (state_) {
    case GroupState::kBooting:
      update_booting(now);
      break;
    case GroupState::kReady:
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
  return feedback_;
}

void DriveGroup::write(Instant now, bool enable, const WheelTargets& targets) noexcept {
  StaticVector<hal::CanFrame, kFramesPerWrite> frames;
  const auto add = [&frames](const hal::CanFrame& frame) { IVO_CONTRACT(frames.push_back(frame)); };
  if (heartbeat_.due(now)) {
    add(heartbeat_frame(master_node_id_, NmtState::kOperational));
  }
  for (WheelDrive& drive : drives_) {
    if (const auto frame = drive.next_frame(now)) {
      add(*frame);
    }
  }
  follow(now, enable);
  if (synchronous_) {
    add(sync_frame());
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      drives_[i].expect_feedback(now);
      const double radps = state_ == GroupState::kEnabled ? targets.radps[i] : 0.0;
      add(drives_[i].command_frame(controlword_for(drives_[i], now), radps));
    }
  }
  if (!frames.empty()) {
    bus_.send(frames.span());
  }
}

void DriveGroup::stop(Instant now) noexcept {
  enable_was_false_ = false;
  const bool powered = state_ == GroupState::kEnabling || state_ == GroupState::kEnabled;
  if (powered) {
    begin_stop(now);
  }
  if (state_ == GroupState::kStopping) {
    voltage_off_ = true;
  }
}

void DriveGroup::reset_fault() noexcept { reset_asked_ = state_ == GroupState::kFault; }

int DriveGroup::answers_awaited() const noexcept {
  return static_cast<int>(
      std::count_if(drives_.begin(), drives_.end(), [](const WheelDrive& drive) { return drive.awaiting_answer(); }));
}

std::uint64_t DriveGroup::malformed() const noexcept {
  std::uint64_t sum = 0;
  for (const WheelDrive& drive : drives_) {
    sum += drive.malformed();
  }
  return sum;
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
  const auto drive = std::find_if(drives_.begin(), drives_.end(), at_fault);
  if (drive != drives_.end()) {
    drive->latch(reason, drive->statusword());
  }
}

void DriveGroup::find_fault(Instant now) noexcept {
  if (state_ == GroupState::kFault && !resetting_) {
    return;
  }
  const auto faulty = std::find_if(drives_.begin(), drives_.end(), [](const WheelDrive& drive) {
    return drive.fault().reason != DriveFaultReason::kNone;
  });
  if (faulty == drives_.end()) {
    return;
  }
  if (state_ != GroupState::kFault && state_ != GroupState::kStopping) {
    quick_stop_since_ = now;
  }
  feedback_.fault = faulty->fault();
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

void DriveGroup::update_enabling(Instant now) noexcept {
  const auto elsewhere = [this](const WheelDrive& drive) { return drive.power_state() != step_; };
  if (feedback_.fresh && std::none_of(drives_.begin(), drives_.end(), elsewhere)) {
    const bool last = step_ == PowerState::kOperationEnabled;
    enter(last ? GroupState::kEnabled : GroupState::kEnabling, now);
    step_ = next_step(step_);
  } else if (now - since_ > rates::kStateChangeTimeout) {
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
    latch_first(DriveFaultReason::kStateChangeTimedOut, [](const WheelDrive& drive) { return !is_off(drive); });
  }
}

void DriveGroup::update_fault(Instant now) noexcept {
  if (resetting_) {
    update_resetting(now);
    return;
  }
  // A reset takes the quick stop away: it waits until the wheels rest or the quick stop had its time.
  const bool at_rest = !synchronous_ || quick_stop_over(now);
  if (!reset_asked_ || !at_rest) {
    return;
  }
  reset_asked_ = false;
  const bool anew = std::any_of(drives_.begin(), drives_.end(), [](const WheelDrive& drive) {
    return drive.phase() != WheelDrive::Phase::kOperational || needs_start_up(drive.fault().reason);
  });
  if (anew) {
    open(now);
    return;
  }
  for (WheelDrive& drive : drives_) {
    drive.clear_fault();
  }
  resetting_ = true;
  since_ = now;
}

void DriveGroup::update_resetting(Instant now) noexcept {
  if (feedback_.fresh && all_off()) {
    resetting_ = false;
    voltage_off_ = true;
    feedback_.fault = {};
    enter(GroupState::kReady, now);
  } else if (now - since_ > rates::kStateChangeTimeout) {
    latch_first(DriveFaultReason::kFaultResetFailed, [](const WheelDrive& drive) { return !is_off(drive); });
  }
}

void DriveGroup::follow(Instant now, bool enable) noexcept {
  if (!enable) {
    enable_was_false_ = true;
  }
  const bool powered = state_ == GroupState::kEnabling || state_ == GroupState::kEnabled;
  if (enable && enable_was_false_ && state_ == GroupState::kReady) {
    enter(GroupState::kEnabling, now);
    step_ = PowerState::kReadyToSwitchOn;
  } else if (!enable && powered) {
    begin_stop(now);
    voltage_off_ = false;
  }
}

void DriveGroup::begin_stop(Instant now) noexcept {
  enter(GroupState::kStopping, now);
  quick_stop_since_ = now;
}

void DriveGroup::enter(GroupState state, Instant now) noexcept {
  state_ = state;
  since_ = now;
}

std::uint16_t DriveGroup::controlword_for(const WheelDrive& drive, Instant now) const noexcept {
  switch (state_) {
    case GroupState::kBooting:
      break;
    case GroupState::kReady:
      return off_word();
    case GroupState::kEnabling:
      return cia402::toward(drive.power_state(), step_);
    case GroupState::kEnabled:
      return controlword::kEnableOperation;
    case GroupState::kStopping:
      return quick_stop_over(now) ? off_word() : controlword::kQuickStop;
    case GroupState::kFault:
      if (resetting_) {
        return in_fault(drive) ? controlword::kFaultReset : controlword::kDisableVoltage;
      }
      return quick_stop_over(now) ? controlword::kDisableVoltage : controlword::kQuickStop;
  }
  return controlword::kDisableVoltage;
}

std::uint16_t DriveGroup::off_word() const noexcept {
  return voltage_off_ ? controlword::kDisableVoltage : controlword::kShutdown;
}

bool DriveGroup::quick_stop_over(Instant now) const noexcept {
  return feedback_.standstill || now - quick_stop_since_ > rates::kStandstillTimeout;
}

bool DriveGroup::all_off() const noexcept { return std::all_of(drives_.begin(), drives_.end(), is_off); }

}  // namespace ivo::drivers
