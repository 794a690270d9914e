// Process data and emergencies of a simulated drive.
#include <algorithm>
#include <chrono>

#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/sim/sim_drive.hpp"
#include "drivers/sim/sim_objects.hpp"

namespace ivo::drivers {
namespace {

using Source = SimEmergencies::Source;

constexpr std::uint16_t kPdoTooShortCode = 0x8210;
constexpr std::uint16_t kPdoTooLongCode = 0x8220;
constexpr std::uint16_t kSyncLengthCode = 0x8240;
constexpr std::uint16_t kRpdoLateCode = 0x8250;

}  // namespace

void SimDrive::configure_pdos() noexcept {
  for (std::size_t i = 0; i < kSimPdos; ++i) {
    rpdos_[i] = sim_pdo(objects_, i, true);
    tpdos_[i].configure(sim_pdo(objects_, i, false));
  }
  rpdo_heard_.fill(std::nullopt);
}

void SimDrive::on_sync(const hal::CanFrame& frame, Outbox& out) noexcept {
  const std::uint8_t expected = objects_.value_or(sim_object::kSyncOverflow, 0) != 0 ? 1 : 0;
  if (frame.size != expected) {
    emergencies_.raise(Source::kSyncLength, kSyncLengthCode, vendor_bytes(), objects_);
    return;
  }
  emergencies_.clear(Source::kSyncLength, vendor_bytes(), objects_);
  last_sync_ = now_;
  for (std::size_t i = 0; i < kSimPdos; ++i) {
    if (rpdo_frames_[i].has_value()) {
      const hal::CanFrame received = *rpdo_frames_[i];
      rpdo_frames_[i].reset();
      apply_rpdo(i, received);
    }
  }
  send_emergencies(out);
  refresh_actual_values();
  for (std::size_t i = 0; i < kSimPdos; ++i) {
    if (const auto tpdo = tpdos_[i].on_sync(objects_, now_)) {
      send_tpdo(i, *tpdo, out);
    }
  }
}

void SimDrive::on_rpdo(std::size_t number, const hal::CanFrame& frame) noexcept {
  rpdo_heard_[number] = now_;
  emergencies_.clear(Source::kRpdoLate, vendor_bytes(), objects_);
  if (!rpdos_[number].synchronous()) {
    apply_rpdo(number, frame);
    return;
  }
  const Duration window = std::chrono::microseconds(objects_.value_or(sim_object::kSyncWindow, 0));
  if (window == Duration::zero() || !last_sync_.has_value() || now_ - *last_sync_ <= window) {
    rpdo_frames_[number] = frame;
  }
}

void SimDrive::apply_rpdo(std::size_t number, const hal::CanFrame& frame) noexcept {
  const SimPdo& pdo = rpdos_[number];
  if (frame.size < pdo.bytes) {
    emergencies_.raise(Source::kRpdoLength, kPdoTooShortCode, vendor_bytes(), objects_);
    return;
  }
  if (frame.size > pdo.bytes) {
    emergencies_.raise(Source::kRpdoLength, kPdoTooLongCode, vendor_bytes(), objects_);
  } else {
    emergencies_.clear(Source::kRpdoLength, vendor_bytes(), objects_);
  }
  std::size_t at = 0;
  bool controlled = false;
  for (const SimMapped& mapped : pdo.mapped) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < mapped.bytes; ++i, ++at) {
      value |= i < 4 ? std::uint32_t{frame.data[at]} << (8 * i) : 0;
    }
    const ObjectEntry* const entry = mapped.dummy() ? nullptr : objects_.find(mapped.address);
    if (entry == nullptr || refusal(*entry, value).has_value()) {
      continue;
    }
    objects_.set(mapped.address, value);
    if (mapped.address == object::kControlword) {
      controlled = true;  // after the rest of the frame
    } else {
      written(mapped.address);
    }
  }
  if (controlled) {
    written(object::kControlword);
  }
}

void SimDrive::watch_rpdo_deadlines() noexcept {
  for (std::size_t i = 0; i < kSimPdos && nmt_ == NmtState::kOperational; ++i) {
    const bool watched = rpdos_[i].valid && rpdos_[i].timer > Duration::zero() && rpdo_heard_[i].has_value();
    if (watched && now_ - *rpdo_heard_[i] > rpdos_[i].timer) {
      rpdo_heard_[i].reset();
      communication_error(Source::kRpdoLate, kRpdoLateCode);
    }
  }
}

void SimDrive::send_event_tpdos(Outbox& out) noexcept {
  if (nmt_ != NmtState::kOperational) {
    return;
  }
  refresh_actual_values();
  for (std::size_t i = 0; i < kSimPdos; ++i) {
    if (const auto frame = tpdos_[i].on_time(objects_, now_)) {
      send_tpdo(i, *frame, out);
    }
  }
}

void SimDrive::send_tpdo(std::size_t number, hal::CanFrame frame, Outbox& out) noexcept {
  if (now_ >= script_.feedback_lost_from || faults_.on(SimFault::kNoTpdo)) {
    return;
  }
  if (faults_.on(SimFault::kStuckTpdo)) {
    frame = tpdos_before_[number].value_or(frame);
  }
  tpdos_before_[number] = frame;
  if (faults_.on(SimFault::kShortTpdo)) {
    frame.size = static_cast<std::uint8_t>(std::min<std::uint32_t>(frame.size, faults_.value(SimFault::kShortTpdo)));
  }
  std::optional<hal::CanFrame>& held = tpdos_held_[number];
  const std::optional<hal::CanFrame> before = held;
  held.reset();
  if (faults_.on(SimFault::kLateTpdo)) {
    held = frame;
    if (before.has_value()) {
      emit(*before, out);
    }
    return;
  }
  if (faults_.on(SimFault::kReorderedTpdo) && !before.has_value()) {
    held = frame;
    return;
  }
  emit(frame, out);
  if (before.has_value()) {
    emit(*before, out);
  }
  if (faults_.on(SimFault::kDuplicateTpdo)) {
    emit(frame, out);
  }
}

void SimDrive::send_emergencies(Outbox& out) noexcept {
  if (nmt_ != NmtState::kOperational && nmt_ != NmtState::kPreOperational) {
    return;
  }
  for (auto frame = emergencies_.next(now_, objects_); frame.has_value(); frame = emergencies_.next(now_, objects_)) {
    emit(*frame, out);
  }
}

}  // namespace ivo::drivers
