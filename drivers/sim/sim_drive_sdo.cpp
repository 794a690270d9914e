// What may be read from and written to a simulated drive, and what a write changes.
#include <algorithm>
#include <chrono>
#include <optional>
#include <span>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/sim/sim_drive.hpp"
#include "drivers/sim/sim_objects.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint32_t kIdBits = 0x7FF;

bool supports(std::uint32_t modes, std::int64_t mode) noexcept {
  return mode == 0 || (mode > 0 && mode <= 32 && (modes >> (mode - 1) & 1) != 0);
}

/// Of the option codes, those that the simulated drive has (sim_power.hpp).
bool option_known(ObjectAddress address, std::int64_t value) noexcept {
  if (address == object::kQuickStopOption) {
    return value == 0 || value == 1 || value == 2 || value == 5 || value == 6;
  }
  if (address == sim_object::kShutdownOption || address == sim_object::kDisableOption) {
    return value == 0 || value == 1;
  }
  if (address == sim_object::kHaltOption) {
    return value == 1 || value == 2;
  }
  if (address == sim_object::kFaultOption) {
    return value >= 0 && value <= 2;
  }
  return address != object::kAbortConnectionOption || (value >= 0 && value <= cia402::kQuickStopOnLostMaster);
}

}  // namespace

void SimDrive::on_sdo(const hal::CanFrame& request, Outbox& out) noexcept {
  const SimSdoServer::Action action = sdo_.on_request(request, faults_);
  if (action == SimSdoServer::Action::kNothing) {
    return;
  }
  if (action == SimSdoServer::Action::kRead) {
    SdoContent content;
    if (const auto refused = upload(sdo_.object(), content)) {
      sdo_.abort(*refused);
    } else {
      sdo_.read(content, faults_);
    }
  } else if (action == SimSdoServer::Action::kWrite) {
    if (const auto refused = download(sdo_.object(), sdo_.content(), sdo_.size_given())) {
      sdo_.abort(*refused);
    } else {
      sdo_.written();
    }
  }
  answer_sdo(sdo_.answer(), out);
}

void SimDrive::answer_sdo(hal::CanFrame frame, Outbox& out) noexcept {
  frame.id = cob_id::sdo_answer(node_id_);
  if (faults_.on(SimFault::kSdoSilent)) {
    return;
  }
  if (faults_.on(SimFault::kSdoWrongIndex)) {
    ++frame.data[1];
  }
  for (int devices = faults_.on(SimFault::kDuplicateNode) ? 2 : 1; devices > 0; --devices) {
    if (!faults_.on(SimFault::kSlowSdo)) {
      emit(frame, out);
    } else if (!delayed_.full()) {
      (void)delayed_.push_back({now_ + std::chrono::milliseconds(faults_.value(SimFault::kSlowSdo, 20)), frame});
    }
  }
}

void SimDrive::send_delayed(Outbox& out) noexcept {
  std::size_t sent = 0;
  while (sent < delayed_.size() && delayed_[sent].due <= now_) {
    emit(delayed_[sent++].frame, out);
  }
  std::copy(delayed_.begin() + sent, delayed_.end(), delayed_.begin());
  delayed_.resize(delayed_.size() - sent);
}

std::optional<SdoAbort> SimDrive::scripted_abort(ObjectAddress address) const noexcept {
  if (script_.refusal.has_value() && script_.refusal->object == address) {
    return script_.refusal->code;
  }
  const ObjectAddress object = faults_.object(SimFault::kSdoAbort);
  if (faults_.on(SimFault::kSdoAbort) && (object == ObjectAddress{} || object == address)) {
    return SdoAbort{faults_.value(SimFault::kSdoAbort, static_cast<std::uint32_t>(SdoAbort::kGeneral))};
  }
  return std::nullopt;
}

std::optional<SdoAbort> SimDrive::upload(ObjectAddress address, SdoContent& content) noexcept {
  if (const auto scripted = scripted_abort(address)) {
    return scripted;
  }
  const ObjectEntry* const entry = objects_.find(address);
  if (entry == nullptr) {
    return objects_.why_missing(address);
  }
  if (!entry->readable) {
    return SdoAbort::kWriteOnly;
  }
  if (entry->is_long()) {
    const std::span<const std::uint8_t> bytes = objects_.content(*entry);
    std::copy(bytes.begin(), bytes.end(), content.bytes.begin());
    content.size = bytes.size();
    return std::nullopt;
  }
  refresh_actual_values();
  const bool other = faults_.on(SimFault::kOtherIdentity) && address == object::kVendorId;
  store(std::span(content.bytes), other ? faults_.value(SimFault::kOtherIdentity) : entry->value);
  content.size = entry->bytes;
  return std::nullopt;
}

std::optional<SdoAbort> SimDrive::download(ObjectAddress address, const SdoContent& content, bool size_given) noexcept {
  if (const auto scripted = scripted_abort(address)) {
    return scripted;
  }
  const ObjectEntry* const entry = objects_.find(address);
  if (entry == nullptr) {
    return objects_.why_missing(address);
  }
  if (script_.stuck.has_value() && script_.stuck->object == address) {
    return script_.stuck->code;
  }
  if (!entry->writable) {
    return SdoAbort::kReadOnly;
  }
  if (entry->is_long()) {
    objects_.set_content(address, std::span(content.bytes).first(content.size));
    return std::nullopt;
  }
  if (size_given ? content.size != entry->bytes : content.size < entry->bytes) {
    return content.size > entry->bytes ? SdoAbort::kLengthTooHigh : SdoAbort::kLengthTooLow;
  }
  const std::uint32_t value = low_bytes(load<std::uint32_t>(content.bytes), entry->bytes);
  if (const auto refused = refusal(*entry, value)) {
    return refused;
  }
  objects_.set(address, value);
  written(address);
  return std::nullopt;
}

std::optional<SdoAbort> SimDrive::refusal(const ObjectEntry& entry, std::uint32_t value) const noexcept {
  const ObjectAddress address = entry.address;
  const std::int64_t number = number_of(entry, value);
  if (number > entry.high) {
    return SdoAbort::kValueTooHigh;
  }
  if (number < entry.low) {
    return SdoAbort::kValueTooLow;
  }
  if (is_pdo_object(address.index)) {
    return nmt_ == NmtState::kOperational ? std::optional(SdoAbort::kDeviceState)
                                          : pdo_refusal(objects_, address, value, dummies_);
  }
  if (address.index == object::kConsumerHeartbeat.index) {
    return SimHeartbeats::refusal(objects_, address.sub, value);
  }
  if (address == sim_object::kSyncOverflow && sync_period() != Duration::zero()) {
    return SdoAbort::kDeviceState;  // CiA 301, 7.5.2.20
  }
  const std::uint32_t before = entry.value;
  const bool emcy_moved = address == sim_object::kEmcyCobId && ((before | value) & cob_id::kPdoInvalid) == 0 &&
                          ((before ^ value) & kIdBits) != 0;
  const bool wrong = emcy_moved || (address == sim_object::kErrorCount && value != 0) ||
                     !option_known(address, number) ||
                     (address == object::kModeOfOperation && !supports(objects_.get(object::kSupportedModes), number));
  return wrong ? std::optional(SdoAbort::kValueRange) : std::nullopt;
}

void SimDrive::written(ObjectAddress address) noexcept {
  const std::uint32_t value = objects_.get(address);
  if (address.index == object::kConsumerHeartbeat.index) {
    heartbeats_.configure(objects_);
    emergencies_.clear(SimEmergencies::Source::kHeartbeat, vendor_bytes(), objects_);
  } else if (address == object::kProducerHeartbeat) {
    heartbeat_ = HeartbeatProducer(std::chrono::milliseconds(value));
  } else if (address == object::kModeOfOperation) {
    const bool refused = script_.refuse_mode || faults_.on(SimFault::kModeRefused);
    objects_.set(object::kModeDisplay, refused ? 0 : value);
  } else if (address == object::kControlword) {
    command(static_cast<std::uint16_t>(value));
  } else if (address == sim_object::kErrorCount) {
    for (std::uint8_t sub = 1; objects_.find({address.index, sub}) != nullptr; ++sub) {
      objects_.set({address.index, sub}, 0);
    }
  } else if (is_pdo_object(address.index)) {
    configure_pdos();
  }
}

}  // namespace ivo::drivers
