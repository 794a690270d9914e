// What a script makes a simulated drive do.
#include <chrono>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/canopen/sync.hpp"
#include "drivers/sim/sim_drive.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint16_t kSensorFault = 0x7300;
constexpr std::uint32_t kSyncProducer = 0x4000'0000;  // bit of 1005h
constexpr int kStormFrames = 4;                       // at most in one call
constexpr Duration kStormPeriod = std::chrono::milliseconds(1);
constexpr Duration kForeignPeriod = std::chrono::milliseconds(50);

}  // namespace

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
    fail(script_.fault_code);
  }
  for (SimEvent& event : script_.events) {
    if (!event.done && now_ >= event.at) {
      event.done = true;
      apply(event, out);
    }
  }
  if (faults_.on(SimFault::kFaultAgain) && !emergencies_.active(SimEmergencies::Source::kDrive)) {
    fail(static_cast<std::uint16_t>(faults_.value(SimFault::kFaultAgain, kSensorFault)));
  }
  power_.set_voltage(!faults_.on(SimFault::kStoOpen));
  power_.forbid_enabling(faults_.on(SimFault::kNotEnabling));
  motion_.set_slip(faults_.on(SimFault::kSlip) ? faults_.value(SimFault::kSlip) : 0);
}

void SimDrive::apply(const SimEvent& event, Outbox& out) noexcept {
  faults_.apply(event);
  if (!event.on) {
    return;
  }
  switch (event.fault) {
    case SimFault::kReboot:
      if (event.value != 0) {
        powered_again_ = now_ + std::chrono::milliseconds(event.value);
      }
      reset(true, out);  // the boot-up message of a later one is not sent yet
      break;
    case SimFault::kLeaveOperational:
      enter(
          static_cast<NmtState>(event.value != 0 ? event.value : static_cast<std::uint32_t>(NmtState::kPreOperational)),
          out);
      break;
    case SimFault::kForeignNmt:
      emit(nmt_frame({static_cast<NmtCommand>(event.value >> 8), static_cast<std::uint8_t>(event.value)}), out);
      break;
    case SimFault::kFault:
      fail(static_cast<std::uint16_t>(event.value != 0 ? event.value : kSensorFault));
      break;
    case SimFault::kDuplicateNode:
      emit(heartbeat_frame(node_id_, NmtState::kBootUp), out);
      break;
    default:
      break;
  }
}

bool SimDrive::due(SimFault fault, SimPeriod& period) noexcept {
  if (!faults_.on(fault)) {
    period.stop();
    return false;
  }
  return period.due(now_, kForeignPeriod, 1) != 0;
}

void SimDrive::produce_sync(Outbox& out) noexcept {
  const bool scripted = faults_.on(SimFault::kSyncProducer);
  const Duration own = sync_period();
  const Duration period =
      scripted ? std::chrono::microseconds(faults_.value(
                     SimFault::kSyncProducer,
                     static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(own).count())))
               : own;
  if ((!scripted && (objects_.value_or(object::kSyncCobId, 0) & kSyncProducer) == 0) || period == Duration::zero()) {
    own_sync_.stop();
  } else if (own_sync_.due(now_, period, 1) != 0) {
    hal::CanFrame frame = sync_frame();
    frame.id = sync_id();
    emit(frame, out);
  }
}

/// What others on the bus, or a drive that thinks it is another, would send.
void SimDrive::play_others(Outbox& out) noexcept {
  produce_sync(out);
  if (due(SimFault::kForeignMaster, foreign_heartbeat_)) {
    const std::uint32_t master = objects_.value_or(object::kConsumerHeartbeat, 0) >> 16 & 0x7F;
    emit(heartbeat_frame(static_cast<std::uint8_t>(faults_.value(SimFault::kForeignMaster, master)),
                         NmtState::kOperational),
         out);
  }
  if (due(SimFault::kForeignClient, foreign_request_)) {
    const hal::CanFrame request =
        sdo_frame(cob_id::sdo_request(node_id_), {sdo_command::kUpload, object::kDeviceType, 0});
    emit(request, out);
    on_sdo(request, out);
  }
  if (due(SimFault::kDuplicateNode, twin_heartbeat_)) {
    emit(heartbeat_frame(node_id_, NmtState::kPreOperational), out);
  }
  if (!faults_.on(SimFault::kEmergencyStorm)) {
    return storm_.stop();
  }
  for (int left = storm_.due(now_, kStormPeriod, kStormFrames); left > 0; --left) {
    emergencies_.say(static_cast<std::uint16_t>(faults_.value(SimFault::kEmergencyStorm, kSensorFault)), vendor_bytes(),
                     objects_);
  }
}

}  // namespace ivo::drivers
