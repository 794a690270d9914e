#include "drivers/sim/sim_drive.hpp"

#include <chrono>

#include "config/base/contract.hpp"
#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/sim/sim_objects.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint16_t kFirstProfileIndex = 0x2000;
constexpr std::uint16_t kLastCommunicationIndex = 0x1FFF;
constexpr std::uint16_t kCommunicationEnded = 0x8100;  // error code: communication, generic

std::uint32_t dummies_of(const EdsDictionary& eds) noexcept {
  std::uint32_t dummies = 0;
  for (std::uint16_t type = 0; type < 32; ++type) {
    dummies |= eds.dummy(static_cast<DataType>(type)) ? std::uint32_t{1} << type : 0;
  }
  return dummies;
}

}  // namespace

SimDrive::SimDrive(const DriveParameters& drive, const SimScript& script, const EdsDictionary& eds) noexcept
    : node_id_(drive.node_id),
      parameters_(drive),
      script_(script),
      dummies_(dummies_of(eds)),
      motion_(drive),
      encoder_(script.noise_counts, script.seed * 2'654'435'761U + drive.node_id) {
  add_sim_objects(objects_, eds, drive, script);
}

void SimDrive::open(Outbox& out) noexcept {
  reset(true, out);
  note_change();
}

bool SimDrive::silent() const noexcept {
  return now_ >= script_.silent_from || faults_.on(SimFault::kSilent) || powered_again_.has_value();
}

bool SimDrive::beats() const noexcept {
  return now_ < script_.heartbeat_lost_from && !faults_.on(SimFault::kNoHeartbeat);
}

void SimDrive::emit(const hal::CanFrame& frame, Outbox& out) const noexcept {
  if (!silent()) {
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
  if (powered_again_.has_value()) {
    if (now_ < *powered_again_) {
      return note_change();
    }
    powered_again_.reset();
    boot(out);
  }
  watch_others(out);
  watch_rpdo_deadlines();
  send_delayed(out);
  if (nmt_ != NmtState::kBootUp && objects_.get(object::kProducerHeartbeat) != 0 && heartbeat_.due(now_)) {
    send_heartbeat(out);
  }
  play_others(out);
  send_emergencies(out);
  send_event_tpdos(out);
  note_change();
}

void SimDrive::send_heartbeat(Outbox& out) noexcept {
  if (beats()) {
    emit(heartbeat_frame(node_id_, nmt_), out);
  }
}

std::uint16_t SimDrive::sync_id() const noexcept {
  return static_cast<std::uint16_t>(objects_.value_or(object::kSyncCobId, cob_id::kSync) & 0x7FF);
}

Duration SimDrive::sync_period() const noexcept {
  return std::chrono::microseconds(objects_.value_or(object::kCyclePeriod, 0));
}

void SimDrive::on_frame(const hal::CanFrame& frame, Outbox& out) noexcept {
  hold_stuck_object();
  if (powered_again_.has_value()) {
    return;
  }
  const bool operational = nmt_ == NmtState::kOperational;
  if (const auto order = parse_nmt(frame)) {
    if (order->node_id == 0 || order->node_id == node_id_) {
      on_nmt(*order, out);
    }
  } else if (frame.id == sync_id()) {
    if (operational) {
      on_sync(frame, out);
    }
  } else if (frame.id == cob_id::sdo_request(node_id_)) {
    if (operational || nmt_ == NmtState::kPreOperational) {
      on_sdo(frame, out);
    }
  } else {
    for (std::size_t i = 0; i < kSimPdos && operational; ++i) {
      if (rpdos_[i].valid && rpdos_[i].cob_id == frame.id) {
        on_rpdo(i, frame);
      }
    }
    heartbeats_.on_frame(frame, now_);
    if (heartbeats_.all_back()) {
      emergencies_.clear(SimEmergencies::Source::kHeartbeat, vendor_bytes(), objects_);
    }
  }
  send_emergencies(out);
  note_change();
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
    lose_connection(kCommunicationEnded);
    rpdo_frames_.fill(std::nullopt);
  }
  nmt_ = state;
  if (nmt_ == NmtState::kOperational) {
    configure_pdos();
  }
  if (objects_.get(object::kProducerHeartbeat) != 0) {
    send_heartbeat(out);
  }
}

void SimDrive::reset(bool application, Outbox& out) noexcept {
  if (application) {
    power_.reset();
    objects_.reset(kFirstProfileIndex, 0xFFFF);
    emergencies_.reset();
  } else if (nmt_ == NmtState::kOperational) {
    lose_connection(kCommunicationEnded);
  }
  objects_.reset(0, kLastCommunicationIndex);
  heartbeats_.configure(objects_);
  emergencies_.clear(SimEmergencies::Source::kHeartbeat, vendor_bytes(), objects_);
  sdo_.reset();
  delayed_.clear();
  rpdo_frames_.fill(std::nullopt);
  tpdos_held_.fill(std::nullopt);
  last_sync_.reset();
  configure_pdos();
  boot(out);
}

void SimDrive::boot(Outbox& out) noexcept {
  nmt_ = NmtState::kPreOperational;
  emit(heartbeat_frame(node_id_, NmtState::kBootUp), out);
}

void SimDrive::note_change() noexcept {
  const SimChange now{now_, powered_again_.has_value() ? NmtState::kBootUp : nmt_, power_.state(), motion_.velocity(),
                      motion_.at_rest()};
  if (!first_change_ && now.nmt == last_change_.nmt && now.power == last_change_.power &&
      now.at_rest == last_change_.at_rest) {
    return;
  }
  first_change_ = false;
  last_change_ = now;
  (void)changes_.push_back(now);
}

}  // namespace ivo::drivers
