#include "drivers/wheel_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drivers/canopen/cob_id.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;

template <class T>
bool keep(std::optional<T>& slot, const std::optional<T>& parsed) noexcept {
  if (parsed.has_value()) {
    slot = parsed;
  }
  return parsed.has_value();
}

}  // namespace

WheelDrive::WheelDrive(const Robot& robot, Wheel wheel) noexcept
    : WheelDrive(robot, robot.drives[static_cast<std::size_t>(wheel)], wheel) {}

WheelDrive::WheelDrive(const Robot& robot, const DriveParameters& drive, Wheel wheel) noexcept
    : node_id_(drive.node_id),
      sign_(drive.sign),
      gear_ratio_(drive.gear_ratio),
      velocity_per_radps_(drive.velocity_per_radps),
      wheel_(wheel),
      startup_(robot, wheel),
      encoder_(drive, robot.base.wheel_radius_m) {}

void WheelDrive::open() noexcept {
  startup_.open();
  encoder_.rebase();
  heartbeat_.forget();
  rhythm_.forget();
  tally_.forget();
  heard_ = {};
  status_ = {};
  fresh_ = false;
  left_operational_ = false;
  sync_.reset();
  last_feedback_.reset();
  fault_ = {};
}

void WheelDrive::expect_feedback(Instant now) noexcept {
  sync_ = now;
  last_feedback_ = last_feedback_.value_or(now);
  tally_.sync();
  fresh_ = false;
}

void WheelDrive::clear_fault() noexcept { fault_ = {}; }

void WheelDrive::latch(DriveFaultReason reason, std::uint32_t code) noexcept {
  if (fault_.reason == DriveFaultReason::kNone) {
    fault_ = {.reason = reason, .node_id = node_id(), .wheel = wheel_, .step = "", .code = code};
  }
}

void WheelDrive::on_frame(const hal::ReceivedFrame& received) noexcept {
  const hal::CanFrame& frame = received.frame;
  const std::uint8_t node = node_id();
  if (frame.id == channels().feedback_id) {
    const bool whole = keep(heard_.feedback, parse_status(frame));
    malformed_ += whole ? 0 : 1;
    if (whole) {
      tally_.heard();
    }
  } else if (frame.id == cob_id::heartbeat(node)) {
    hear_heartbeat(received);
  } else if (frame.id == cob_id::sdo_answer(node)) {
    startup_.on_sdo(frame);
  } else if (frame.id == cob_id::emcy(node)) {
    const std::optional<Emergency> emergency = parse_emergency(frame);
    malformed_ += emergency.has_value() ? 0 : 1;
    if (emergency.has_value()) {
      emergencies_.add(*emergency, received.at);
    }
    const bool errors_gone = emergency.has_value() && emergency->code == 0;
    if (!errors_gone && !heard_.emergency.has_value()) {
      heard_.emergency = emergency.value_or(Emergency{});
    }
  }
}

void WheelDrive::hear_heartbeat(const hal::ReceivedFrame& received) noexcept {
  const std::optional<NmtState> state = parse_heartbeat(received.frame);
  if (!state.has_value()) {
    ++malformed_;
  } else if (*state == NmtState::kBootUp) {
    heard_.boot_up = true;
    startup_.on_boot_up();
  } else {
    heard_.heartbeat = state;
    rhythm_.heard(received.at);
    startup_.on_heartbeat(*state);
  }
}

void WheelDrive::update(Instant now) noexcept {
  startup_.update(now);
  if (startup_.phase() == Phase::kFailed && fault_.reason == DriveFaultReason::kNone) {
    fault_ = startup_.fault();
  }
  if (heard_.feedback.has_value() && sync_.has_value()) {
    status_ = *heard_.feedback;
    encoder_.sample(status_.position, *sync_);
    fresh_ = true;
    last_feedback_ = now;
  }
  if (startup_.phase() == Phase::kOperational) {
    watch(now);
  }
  heard_ = {};
}

void WheelDrive::watch(Instant now) noexcept {
  if (heard_.heartbeat.has_value()) {
    heartbeat_.heard(now);
    left_operational_ = *heard_.heartbeat != NmtState::kOperational;
  }
  left_operational_ = left_operational_ || heard_.boot_up;
  if (heard_.boot_up) {
    latch(DriveFaultReason::kRebooted, 0);
  } else if (heard_.emergency.has_value()) {
    latch(DriveFaultReason::kEmergency, heard_.emergency->code);
  } else if (heard_.heartbeat.value_or(NmtState::kOperational) != NmtState::kOperational) {
    latch(DriveFaultReason::kLeftOperational, static_cast<std::uint32_t>(*heard_.heartbeat));
  } else if (heartbeat_.lost(now)) {
    latch(DriveFaultReason::kHeartbeatLost, 0);
  } else if (last_feedback_.has_value() && !answers(now)) {
    latch(DriveFaultReason::kFeedbackLost, 0);
  } else if (tally_.erratic()) {
    latch(DriveFaultReason::kFeedbackErratic, tally_.irregular());
  } else if (rhythm_.twins()) {
    latch(DriveFaultReason::kDuplicateNodeId, 0);
  }
}

bool WheelDrive::off() const noexcept {
  const PowerState state = power_state();
  return state == PowerState::kNotReadyToSwitchOn || state == PowerState::kSwitchOnDisabled ||
         state == PowerState::kReadyToSwitchOn;
}

bool WheelDrive::powered() const noexcept {
  const PowerState state = power_state();
  return state == PowerState::kSwitchedOn || state == PowerState::kOperationEnabled ||
         state == PowerState::kQuickStopActive;
}

bool WheelDrive::in_fault() const noexcept {
  const PowerState state = power_state();
  return state == PowerState::kFault || state == PowerState::kFaultReactionActive;
}

DriveCommand WheelDrive::command(std::uint16_t controlword, double radps) const noexcept {
  constexpr double kLowest = std::numeric_limits<std::int32_t>::min();
  constexpr double kHighest = std::numeric_limits<std::int32_t>::max();
  const double units = radps * sign_ * gear_ratio_ * velocity_per_radps_;
  const double target = std::isnan(units) ? 0.0 : std::clamp(std::round(units), kLowest, kHighest);
  return {controlword, static_cast<std::int32_t>(target)};
}

}  // namespace ivo::drivers
