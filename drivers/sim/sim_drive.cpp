#include "drivers/sim/sim_drive.hpp"

#include <bit>
#include <chrono>
#include <span>

#include "config/base/contract.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/emcy.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/sim/sim_objects.hpp"

namespace ivo::drivers {
namespace {

using cia402::PowerState;

constexpr std::uint16_t kHeartbeatLostCode = 0x8130;
constexpr std::uint16_t kPdoLengthCode = 0x8210;
constexpr std::uint16_t kVoltageAndRemote = 0x0210;
constexpr std::uint16_t kFollowsTarget = 0x1000;
constexpr std::uint8_t kHighestSynchronous = 240;
constexpr std::uint16_t kFirstProfileIndex = 0x6000;
constexpr std::uint16_t kLastCommunicationIndex = 0x1FFF;

struct MappedObject {
  ObjectAddress address;
  std::uint8_t bits = 0;
};

MappedObject unpack(std::uint32_t entry) noexcept {
  return {{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8)},
          static_cast<std::uint8_t>(entry)};
}

std::uint16_t id_of(std::uint32_t cob_id_entry) noexcept { return static_cast<std::uint16_t>(cob_id_entry & 0x7FF); }

}  // namespace

SimDrive::SimDrive(const DriveParameters& drive, const SimScript& script) noexcept
    : node_id_(drive.node_id), script_(script), objects_(sim_objects(drive, script)), motion_(drive) {}

void SimDrive::open(Outbox& out) noexcept { reset(true, out); }

void SimDrive::emit(const hal::CanFrame& frame, Outbox& out) const noexcept {
  if (now_ < script_.silent_from) {
    IVO_CONTRACT(out.push_back(frame));
  }
}

void SimDrive::advance_to(Instant now, Outbox& out) noexcept {
  hold_stuck_object();
  const auto passed = std::chrono::duration_cast<std::chrono::microseconds>(now - now_);
  if (passed.count() > 0) {
    now_ += passed;
    move(passed);
  }
  follow_script(out);
  watch_master(out);
  const bool produces = nmt_ != NmtState::kBootUp && objects_.get(object::kProducerHeartbeat) != 0;
  if (produces && heartbeat_.due(now_) && now_ < script_.heartbeat_lost_from) {
    emit(heartbeat_frame(node_id_, nmt_), out);
  }
}

void SimDrive::move(Duration time) noexcept {
  const auto get = [this](ObjectAddress address) { return objects_.get(address); };
  const bool stops =
      power_.state() == PowerState::kQuickStopActive || power_.state() == PowerState::kFaultReactionActive;
  const bool follows = power_.state() == PowerState::kOperationEnabled && get(object::kModeDisplay) != 0;
  const std::uint32_t down = get(stops ? object::kQuickStopDeceleration : object::kProfileDeceleration);
  const std::int32_t target = follows ? std::bit_cast<std::int32_t>(get(object::kTargetVelocity)) : 0;
  motion_.advance(time, target, {get(object::kProfileAcceleration), down});
  if (motion_.at_rest()) {
    power_.at_rest(get(object::kQuickStopOption) >= cia402::kFirstQuickStopThatStays);
  }
}

void SimDrive::hold_stuck_object() noexcept {
  if (script_.stuck.has_value()) {
    objects_.set(script_.stuck->object, script_.stuck->value);
  }
}

void SimDrive::follow_script(Outbox& out) noexcept {
  if (now_ >= script_.reboot_at) {
    script_.reboot_at = SimScript::kNever;
    reset(true, out);
  }
  if (now_ >= script_.fault_at) {
    script_.fault_at = SimScript::kNever;
    fail(script_.fault_code, out);
  }
}

void SimDrive::watch_master(Outbox& out) noexcept {
  if (!master_.lost(now_)) {
    return;
  }
  master_.forget();
  master_lost_ = true;
  emit_emergency(kHeartbeatLostCode, out);
  lose_connection(out);
}

void SimDrive::lose_connection(Outbox& out) noexcept {
  switch (objects_.get(object::kAbortConnectionOption)) {
    case 1:
      fail(kHeartbeatLostCode, out);
      break;
    case 2:
      power_.disable_voltage();
      break;
    case cia402::kQuickStopOnLostMaster:
      power_.quick_stop();
      break;
    default:
      break;
  }
}

void SimDrive::fail(std::uint16_t code, Outbox& out) noexcept {
  power_.fault();
  objects_.set(object::kErrorCode, code);
  objects_.set(object::kErrorRegister, 1);
  emit_emergency(code, out);
}

void SimDrive::emit_emergency(std::uint16_t code, Outbox& out) noexcept {
  emit(emergency_frame(node_id_, {code, static_cast<std::uint8_t>(objects_.get(object::kErrorRegister))}), out);
}

Duration SimDrive::sync_period() const noexcept {
  return std::chrono::microseconds(objects_.get(object::kCyclePeriod));
}

void SimDrive::on_frame(const hal::CanFrame& frame, Outbox& out) noexcept {
  hold_stuck_object();
  const bool operational = nmt_ == NmtState::kOperational;
  const std::uint32_t rpdo = objects_.get(object::kRpdo1CobId);
  const std::uint32_t master = objects_.get(object::kConsumerHeartbeat);
  if (const auto order = parse_nmt(frame)) {
    if (order->node_id == 0 || order->node_id == node_id_) {
      on_nmt(*order, out);
    }
  } else if (frame.id == cob_id::kSync && operational) {
    on_sync(out);
  } else if (frame.id == cob_id::sdo_request(node_id_) && (operational || nmt_ == NmtState::kPreOperational)) {
    if (const auto request = parse_sdo(frame)) {
      on_sdo(*request, out);
    }
  } else if (operational && frame.id == id_of(rpdo) && (rpdo & cob_id::kPdoInvalid) == 0) {
    if (objects_.get(object::kRpdo1Type) <= kHighestSynchronous) {
      rpdo_ = frame;
    } else {
      apply_rpdo(frame, out);
    }
  } else if (frame.id == cob_id::heartbeat(static_cast<std::uint8_t>(master >> 16 & 0x7F)) && (master & 0xFFFF) != 0) {
    master_.heard(now_);
    if (master_lost_) {
      master_lost_ = false;
      emit_emergency(0, out);
    }
  }
}

void SimDrive::on_nmt(NmtOrder order, Outbox& out) noexcept {
  switch (order.command) {
    case NmtCommand::kStart:
      return enter(NmtState::kOperational, out);
    case NmtCommand::kStop:
      return enter(NmtState::kStopped, out);
    case NmtCommand::kEnterPreOperational:
      return enter(NmtState::kPreOperational, out);
    case NmtCommand::kResetNode:
      return reset(true, out);
    case NmtCommand::kResetCommunication:
      return reset(false, out);
  }
}

void SimDrive::enter(NmtState state, Outbox& out) noexcept {
  if (state == nmt_) {
    return;
  }
  if (nmt_ == NmtState::kOperational) {
    lose_connection(out);
    rpdo_.reset();
  }
  nmt_ = state;
  if (objects_.get(object::kProducerHeartbeat) != 0 && now_ < script_.heartbeat_lost_from) {
    emit(heartbeat_frame(node_id_, nmt_), out);
  }
}

void SimDrive::reset(bool application, Outbox& out) noexcept {
  if (application) {
    power_.reset();
    objects_.reset(kFirstProfileIndex, 0xFFFF);
  } else if (nmt_ == NmtState::kOperational) {
    lose_connection(out);
  }
  objects_.reset(0, kLastCommunicationIndex);
  master_.forget();
  master_lost_ = false;
  rpdo_.reset();
  syncs_ = 0;
  nmt_ = NmtState::kPreOperational;
  emit(heartbeat_frame(node_id_, NmtState::kBootUp), out);
}

void SimDrive::on_sync(Outbox& out) noexcept {
  if (rpdo_.has_value()) {
    apply_rpdo(*rpdo_, out);
    rpdo_.reset();
  }
  const std::uint32_t type = objects_.get(object::kTpdo1Type);
  const bool valid = (objects_.get(object::kTpdo1CobId) & cob_id::kPdoInvalid) == 0;
  if (!valid || type == 0 || type > kHighestSynchronous || ++syncs_ < type) {
    return;
  }
  syncs_ = 0;
  if (now_ < script_.feedback_lost_from) {
    send_tpdo(out);
  }
}

void SimDrive::apply_rpdo(const hal::CanFrame& frame, Outbox& out) noexcept {
  if (frame.size * 8 < mapped_bits(object::kRpdo1Count)) {
    emit_emergency(kPdoLengthCode, out);
    return;
  }
  std::span<const std::uint8_t> bytes(frame.data);
  bool controlled = false;
  for (std::uint32_t n = 1; n <= objects_.get(object::kRpdo1Count); ++n) {
    const MappedObject mapped =
        unpack(objects_.get(object::mapping_entry(object::kRpdo1Count, static_cast<std::uint8_t>(n))));
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < mapped.bits / 8U; ++i) {
      value |= std::uint32_t{bytes[i]} << (8 * i);
    }
    bytes = bytes.subspan(mapped.bits / 8U);
    objects_.set(mapped.address, value);
    controlled = controlled || mapped.address == object::kControlword;
  }
  if (controlled) {
    command(static_cast<std::uint16_t>(objects_.get(object::kControlword)), out);
  }
}

void SimDrive::command(std::uint16_t controlword, Outbox& out) noexcept {
  const PowerState before = power_.state();
  power_.command(controlword);
  if (before == PowerState::kFault && power_.state() != PowerState::kFault) {
    objects_.set(object::kErrorCode, 0);
    objects_.set(object::kErrorRegister, 0);
    emit_emergency(0, out);
  }
}

void SimDrive::send_tpdo(Outbox& out) noexcept {
  refresh_actual_values();
  hal::CanFrame frame{.id = id_of(objects_.get(object::kTpdo1CobId)), .size = 0, .data = {}};
  for (std::uint32_t n = 1; n <= objects_.get(object::kTpdo1Count); ++n) {
    const MappedObject mapped =
        unpack(objects_.get(object::mapping_entry(object::kTpdo1Count, static_cast<std::uint8_t>(n))));
    const std::uint32_t value = objects_.get(mapped.address);
    for (std::size_t i = 0; i < mapped.bits / 8U; ++i) {
      frame.data[frame.size++] = static_cast<std::uint8_t>(value >> (8 * i));
    }
  }
  emit(frame, out);
}

int SimDrive::mapped_bits(ObjectAddress count) const noexcept {
  int bits = 0;
  for (std::uint32_t n = 1; n <= objects_.get(count); ++n) {
    bits += unpack(objects_.get(object::mapping_entry(count, static_cast<std::uint8_t>(n)))).bits;
  }
  return bits;
}

void SimDrive::refresh_actual_values() noexcept {
  const bool follows = power_.state() == PowerState::kOperationEnabled;
  const int word = cia402::statusword_bits(power_.state()) | kVoltageAndRemote | (follows ? kFollowsTarget : 0);
  objects_.set(object::kStatusword, static_cast<std::uint32_t>(word));
  objects_.set(object::kPositionActual, std::bit_cast<std::uint32_t>(motion_.position()));
  objects_.set(object::kVelocityActual, std::bit_cast<std::uint32_t>(motion_.velocity()));
}

}  // namespace ivo::drivers
