// The motor of a simulated drive: its power states, its targets and what it does when its connection is lost.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/mode.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/sim/sim_drive.hpp"
#include "drivers/sim/sim_objects.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;

constexpr std::uint16_t kHeartbeatLostCode = 0x8130;
constexpr std::uint32_t kFastest = 0x7FFF'FFFF;
constexpr std::uint32_t kReached = 100;  // target reached: within a hundredth of it

// Bits of the statusword beyond the state's (CiA 402-2, 6.1.2).
constexpr std::uint16_t kVoltage = 0x0010;
constexpr std::uint16_t kRemote = 0x0200;
constexpr std::uint16_t kTargetReached = 0x0400;
constexpr std::uint16_t kInternalLimit = 0x0800;
constexpr std::uint16_t kModeBit12 = 0x1000;  // profile velocity: stands; cyclic: follows the target

std::uint32_t scaled(double value) noexcept {
  return static_cast<std::uint32_t>(std::llround(std::clamp(value, 0.0, 4.0e9)));
}

}  // namespace

SimOptionCodes SimDrive::options() const noexcept {
  const auto value = [this](ObjectAddress address, std::uint8_t fallback) {
    return static_cast<std::uint8_t>(objects_.value_or(address, fallback));
  };
  return {.quick_stop = value(object::kQuickStopOption, 2),
          .shutdown = value(sim_object::kShutdownOption, 0),
          .disable = value(sim_object::kDisableOption, 1),
          .halt = value(sim_object::kHaltOption, 1),
          .fault_reaction = value(sim_object::kFaultOption, 2)};
}

bool SimDrive::follows() const noexcept {
  const auto mode = static_cast<cia402::Mode>(objects_.get(object::kModeDisplay));
  const bool velocity = mode == cia402::Mode::kProfileVelocity || mode == cia402::Mode::kCyclicSynchronousVelocity;
  return velocity && power_.action(options()) == SimMotorAction::kFollow;
}

std::int32_t SimDrive::limited_target() const noexcept {
  std::uint32_t fastest = std::min(objects_.value_or(sim_object::kMaxMotorSpeed, kFastest), kFastest);
  if (objects_.get(object::kModeDisplay) == static_cast<std::uint8_t>(cia402::Mode::kProfileVelocity)) {
    fastest = std::min(objects_.value_or(sim_object::kMaxProfileVelocity, kFastest), fastest);
  }
  const auto most = static_cast<std::int32_t>(fastest);
  return std::clamp(std::bit_cast<std::int32_t>(objects_.get(object::kTargetVelocity)), -most, most);
}

void SimDrive::move(Duration time) noexcept {
  const double velocity_per_acceleration = parameters_.velocity_per_radps / parameters_.accel_per_radps2;
  const auto ramp = [&](ObjectAddress address) {
    return scaled(objects_.value_or(address, 0) * velocity_per_acceleration);
  };
  const SimOptionCodes codes = options();
  const SimMotorAction action = faults_.on(SimFault::kStoOpen) ? SimMotorAction::kCoast : power_.action(codes);
  SimMotion::Ramp along{ramp(object::kProfileAcceleration), ramp(object::kProfileDeceleration)};
  if (action == SimMotorAction::kQuickRamp) {
    along.down = ramp(object::kQuickStopDeceleration);
  } else if (action == SimMotorAction::kCoast) {
    along.down = scaled(script_.coast_radps2 * parameters_.gear_ratio * parameters_.velocity_per_radps);
  }
  if (power_.state() == PowerState::kQuickStopActive && faults_.on(SimFault::kEndlessStop)) {
    along = {};
  }
  if (faults_.on(SimFault::kBlocked)) {
    motion_.block();
  }
  motion_.advance(time, follows() && !faults_.on(SimFault::kBlocked) ? limited_target() : 0, along);
  encoder_.sample(motion_, faults_.on(SimFault::kEncoderStuck));
  if (motion_.at_rest()) {
    power_.at_rest(codes);
  }
}

void SimDrive::command(std::uint16_t controlword) noexcept {
  const PowerState before = power_.state();
  power_.command(controlword, options());
  if (power_.state() == PowerState::kOperationEnabled && motion_.at_rest()) {
    power_.at_rest(options());
  }
  if (before == PowerState::kFault && power_.state() != PowerState::kFault) {
    objects_.set(object::kErrorCode, 0);
    emergencies_.clear(SimEmergencies::Source::kDrive, vendor_bytes(), objects_);
  }
}

void SimDrive::fail(std::uint16_t code) noexcept {
  power_.fault(options());
  objects_.set(object::kErrorCode, code);
  emergencies_.raise(SimEmergencies::Source::kDrive, code, vendor_bytes(), objects_);
}

void SimDrive::lose_connection(std::uint16_t code) noexcept {
  if (power_.state() == PowerState::kFault || power_.state() == PowerState::kFaultReactionActive) {
    return;
  }
  switch (objects_.value_or(object::kAbortConnectionOption, 1)) {
    case 1:
      fail(code);
      break;
    case 2:
      power_.disable_voltage();
      break;
    case cia402::kQuickStopOnLostMaster:
      power_.quick_stop(options());
      break;
    default:
      break;
  }
}

void SimDrive::communication_error(SimEmergencies::Source source, std::uint16_t code) noexcept {
  if (objects_.value_or(object::kAbortConnectionOption, 1) != 1) {
    emergencies_.raise(source, code, vendor_bytes(), objects_);
  }
  lose_connection(code);
}

void SimDrive::watch_others(Outbox& out) noexcept {
  if (!heartbeats_.newly_lost(now_)) {
    return;
  }
  communication_error(SimEmergencies::Source::kHeartbeat, kHeartbeatLostCode);
  const std::uint32_t behaviour = objects_.value_or(sim_object::kErrorBehaviour, 0);
  if (nmt_ == NmtState::kOperational && behaviour != 1) {
    enter(behaviour == 2 ? NmtState::kStopped : NmtState::kPreOperational, out);
  }
}

std::uint16_t SimDrive::statusword() const noexcept {
  std::uint32_t word = cia402::statusword_bits(power_.state()) | kRemote;
  word |= faults_.on(SimFault::kStoOpen) ? 0 : kVoltage;
  const std::int32_t target = limited_target();
  const bool cyclic =
      objects_.get(object::kModeDisplay) == static_cast<std::uint8_t>(cia402::Mode::kCyclicSynchronousVelocity);
  if (follows()) {
    word |= std::bit_cast<std::int32_t>(objects_.get(object::kTargetVelocity)) != target ? kInternalLimit : 0;
    word |= cyclic ? kModeBit12 : 0;
    const std::int64_t off = std::abs(std::int64_t{target} - motion_.velocity());
    word |= !cyclic && off * kReached <= std::abs(std::int64_t{target}) ? kTargetReached : 0;
  }
  word |= power_.state() == PowerState::kOperationEnabled && power_.halted() && motion_.at_rest() ? kTargetReached : 0;
  word |= !cyclic && motion_.at_rest() ? kModeBit12 : 0;
  return static_cast<std::uint16_t>(word);
}

void SimDrive::refresh_actual_values() noexcept {
  objects_.set(object::kStatusword, statusword());
  objects_.set(object::kPositionActual, std::bit_cast<std::uint32_t>(encoder_.position()));
  objects_.set(object::kVelocityActual, std::bit_cast<std::uint32_t>(encoder_.velocity()));
}

SimEmergencies::Vendor SimDrive::vendor_bytes() const noexcept {
  const std::uint16_t word = statusword();
  return {static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
          static_cast<std::uint8_t>(objects_.get(object::kModeDisplay)), static_cast<std::uint8_t>(nmt_), node_id_};
}

}  // namespace ivo::drivers
