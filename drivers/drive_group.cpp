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

constexpr int kSyncsToAct = 2;  // the first one lets an RPDO act, what a drive sends at the second is from after it

bool tells_off(std::uint16_t word) noexcept {
  return word == controlword::kDisableVoltage || word == controlword::kShutdown || word == controlword::kFaultReset;
}

}  // namespace

DriveGroup::DriveGroup(hal::CanBus& bus, const Robot& robot) noexcept
    : bus_(bus),
      drives_{WheelDrive(robot, Wheel::kFrontLeft), WheelDrive(robot, Wheel::kFrontRight),
              WheelDrive(robot, Wheel::kRearLeft), WheelDrive(robot, Wheel::kRearRight)},
      watch_(robot),
      master_node_id_(robot.master_node_id),
      layout_(robot.pdo_layout) {}

void DriveGroup::open(Instant now) noexcept {
  for (WheelDrive& drive : drives_) {
    drive.open();
  }
  watch_.open(bus_);
  enter(GroupState::kBooting, now);
  synchronous_ = false;
  controlwords_.forget();
  enable_was_false_ = false;
  voltage_off_ = true;
  told_off_ = false;
  syncs_since_off_ = 0;
  unsent_writes_ = 0;
  disobeyed_ = false;
  reset_asked_ = false;
  resetting_ = false;
  feedback_.fault = {};
}

void DriveGroup::on_frame(const hal::ReceivedFrame& received) noexcept {
  watch_.on_frame(received.frame);
  for (WheelDrive& drive : drives_) {
    if (drive.node_id() == cob_id::node_of(received.frame.id)) {
      drive.on_frame(received);
      return;
    }
  }
}

void DriveGroup::write(Instant now, bool enable, const WheelTargets& targets) noexcept {
  StaticVector<hal::CanFrame, kFramesPerWrite> frames;
  const auto add = [&frames](const hal::CanFrame& frame) { IVO_CONTRACT(frames.push_back(frame)); };
  for (WheelDrive& drive : drives_) {
    if (const auto frame = drive.next_frame(now)) {
      add(*frame);
    }
  }
  follow(now, enable);
  if (state_ == GroupState::kFault && synchronous_ && last_word_.due(now)) {
    for (const WheelDrive& drive : drives_) {
      if (!drive.answers(now) || disobeys(drive, now)) {
        add(nmt_frame({NmtCommand::kEnterPreOperational, drive.node_id()}));
      }
    }
  }
  if (synchronous_) {
    add(sync_frame());
    syncs_since_off_ = told_off_ ? std::min(syncs_since_off_ + 1, kSyncsToAct) : 0;
    told_off_ = true;
    GroupCommands commands{};
    GroupChannels channels{};
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      drives_[i].expect_feedback(now);
      const double radps = state_ == GroupState::kEnabled ? targets.radps[i] : 0.0;
      const std::uint16_t word = controlword_for(drives_[i], now);
      told_off_ = told_off_ && tells_off(word);
      commands[i] = drives_[i].command(word, radps);
      channels[i] = drives_[i].channels();
    }
    const CommandFrames command = command_frames(layout_, channels, commands, controlwords_.due(commands, now));
    std::for_each(command.begin(), command.end(), add);
  }
  if (may_say_alive(now) && heartbeat_.due(now)) {
    add(heartbeat_frame(master_node_id_, NmtState::kOperational));
  }
  send(frames.span(), now);
}

void DriveGroup::send(std::span<const hal::CanFrame> frames, Instant now) noexcept {
  const bool whole = bus_.send(frames, now) == frames.size();
  // What only waits leaves with the next call; what was dropped has to be said again.
  if (const std::uint64_t dropped = bus_.counters().send_dropped; dropped != dropped_before_) {
    dropped_before_ = dropped;
    controlwords_.forget();
  }
  if (whole) {
    unsent_writes_ = 0;
    return;
  }
  unsent_writes_ = std::min(unsent_writes_ + 1, kUnsentWrites);
  told_off_ = false;
  syncs_since_off_ = 0;
}

bool DriveGroup::may_say_alive(Instant now) noexcept {
  disobeyed_ = disobeyed_ || std::ranges::any_of(drives_, [&](const WheelDrive& d) { return disobeys(d, now); });
  return unsent_writes_ == 0 && !disobeyed_ && std::ranges::all_of(drives_, &WheelDrive::stopped);
}

bool DriveGroup::disobeys(const WheelDrive& drive, Instant now) const noexcept {
  const bool in_time = now - since_ <= rates::kStandstillTimeout + rates::kStateChangeTimeout;
  return state_ == GroupState::kFault && !resetting_ && synchronous_ && !in_time && drive.answers(now) &&
         drive.powered();
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

void DriveGroup::fail(const DriveFault& fault, Instant now) noexcept {
  if (state_ == GroupState::kFault && !resetting_) {
    return;
  }
  DriveFault named = fault;
  if (fault.reason == DriveFaultReason::kEncoderStuck) {
    named.node_id = drives_[static_cast<std::size_t>(fault.wheel)].node_id();
  }
  enter_fault(named, now);
  feedback_.state = state_;
  feedback_.off = may_end(now);
}

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

void DriveGroup::follow(Instant now, bool enable) noexcept {
  if (!enable) {
    enable_was_false_ = true;
  }
  const bool powered = state_ == GroupState::kEnabling || state_ == GroupState::kEnabled;
  if (enable && enable_was_false_ && state_ == GroupState::kReady) {
    enter(GroupState::kEnabling, now);
    step_ = PowerState::kReadyToSwitchOn;
    was_enabled_ = true;
  } else if (!enable && powered) {
    begin_stop(now);
    voltage_off_ = false;
  }
}

void DriveGroup::begin_stop(Instant now) noexcept {
  enter(GroupState::kStopping, now);
  begin_quick_stop(now);
}

void DriveGroup::enter(GroupState state, Instant now) noexcept {
  state_ = state;
  since_ = now;
  powered_since_.reset();
}

std::uint16_t DriveGroup::controlword_for(const WheelDrive& drive, Instant now) const noexcept {
  switch (state_) {
    case GroupState::kBooting:
      break;
    case GroupState::kReady:
      return off_word(drive);
    case GroupState::kEnabling:
      return cia402::toward(drive.power_state(), step_);
    case GroupState::kEnabled:
      return controlword::kEnableOperation;
    case GroupState::kStopping:
      return quick_stop_over(now) ? off_word(drive) : controlword::kQuickStop;
    case GroupState::kFault:
      if (resetting_) {
        // Not yet in the fault's reaction: the edge would be lost.
        return drive.power_state() == PowerState::kFault ? controlword::kFaultReset : controlword::kDisableVoltage;
      }
      return quick_stop_over(now) ? controlword::kDisableVoltage : controlword::kQuickStop;
  }
  return controlword::kDisableVoltage;
}

// No way leads from Quick Stop Active to Ready to Switch On; a drive whose 605Ah keeps it there leaves by this.
std::uint16_t DriveGroup::off_word(const WheelDrive& drive) const noexcept {
  return voltage_off_ || drive.power_state() == PowerState::kQuickStopActive ? controlword::kDisableVoltage
                                                                             : controlword::kShutdown;
}

bool DriveGroup::quick_stop_over(Instant now) const noexcept {
  return feedback_.standstill || now - quick_stop_since_ > rates::kStandstillTimeout;
}

bool DriveGroup::may_end(Instant now) const noexcept {
  if (state_ == GroupState::kBooting) {
    return true;
  }
  if (state_ != GroupState::kReady && state_ != GroupState::kFault) {
    return false;
  }
  if (!synchronous_) {
    return std::all_of(drives_.begin(), drives_.end(),
                       [](const WheelDrive& drive) { return drive.stopped_or_failed(); });
  }
  const auto answers = [now](const WheelDrive& drive) { return drive.answers(now); };
  if (!was_enabled_ && std::none_of(drives_.begin(), drives_.end(), answers)) {
    return true;
  }
  return syncs_since_off_ == kSyncsToAct && std::all_of(drives_.begin(), drives_.end(), [&](const WheelDrive& drive) {
           return !answers(drive) || drive.off() || drive.power_state() == PowerState::kFault;
         });
}

bool DriveGroup::all_off() const noexcept { return std::ranges::all_of(drives_, &WheelDrive::off); }

}  // namespace ivo::drivers
