// The SDO server of a simulated drive: expedited transfers, and what may be written when.
#include <chrono>
#include <optional>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/objects.hpp"
#include "drivers/sim/sim_drive.hpp"
#include "drivers/sim/sim_objects.hpp"

namespace ivo::drivers {
namespace {

bool is_mapping(std::uint16_t index) noexcept {
  return index == object::kRpdo1Count.index || index == object::kTpdo1Count.index;
}

bool is_pdo(std::uint16_t index) noexcept {
  return is_mapping(index) || index == object::kRpdo1CobId.index || index == object::kTpdo1CobId.index;
}

bool supports(std::uint32_t modes, std::uint32_t mode) noexcept {
  return mode == 0 || (mode <= 32 && (modes >> (mode - 1) & 1) != 0);
}

}  // namespace

void SimDrive::on_sdo(const SdoMessage& request, Outbox& out) noexcept {
  const auto answer = [&](std::uint8_t command, std::uint32_t data) {
    emit(sdo_frame(cob_id::sdo_answer(node_id_), {command, request.address, data}), out);
  };
  const auto abort = [&](SdoAbort code) { answer(sdo_command::kAbort, static_cast<std::uint32_t>(code)); };

  const std::uint8_t service = request.command & sdo_command::kServiceMask;
  if (service == sdo_command::kAbort) {
    return;
  }
  if (service != sdo_command::kUpload && service != sdo_command::kDownload) {
    return abort(SdoAbort::kCommandSpecifier);
  }
  if (script_.refusal.has_value() && script_.refusal->object == request.address) {
    return abort(script_.refusal->code);
  }
  const ObjectEntry* const entry = objects_.find(request.address);
  if (entry == nullptr) {
    return abort(objects_.why_missing(request.address));
  }
  if (service == sdo_command::kUpload) {
    refresh_actual_values();
    return answer(sdo_command::expedited(sdo_command::kUpload, entry->bytes), entry->value);
  }
  const bool stuck = script_.stuck.has_value() && script_.stuck->object == request.address;
  if (const auto refused = stuck ? script_.stuck->code : download(request, out)) {
    return abort(*refused);
  }
  answer(sdo_command::kDownloaded, 0);
}

std::optional<SdoAbort> SimDrive::download(const SdoMessage& request, Outbox& out) noexcept {
  const ObjectEntry& entry = *objects_.find(request.address);
  if (entry.access == ObjectAccess::kReadOnly) {
    return SdoAbort::kReadOnly;
  }
  if ((request.command & sdo_command::kExpedited) == 0) {
    return SdoAbort::kCommandSpecifier;
  }
  const std::uint8_t bytes = sdo_command::bytes_in(request.command).value_or(entry.bytes);
  if (bytes != entry.bytes) {
    return bytes > entry.bytes ? SdoAbort::kLengthTooHigh : SdoAbort::kLengthTooLow;
  }
  const std::uint32_t value = low_bytes(request.data, bytes);
  if (const auto refused = refusal(entry, value)) {
    return refused;
  }
  objects_.set(request.address, value);
  written(request.address, out);
  return std::nullopt;
}

std::optional<SdoAbort> SimDrive::refusal(const ObjectEntry& entry, std::uint32_t value) const noexcept {
  const ObjectAddress address = entry.address;
  if (is_pdo(address.index) && nmt_ == NmtState::kOperational) {
    return SdoAbort::kDeviceState;
  }
  if (is_mapping(address.index)) {
    return mapping_refusal(address, value);
  }
  const bool in_range = [&] {
    if (address == object::kModeOfOperation) {
      return supports(script_.supported_modes, value);
    }
    if (address == object::kQuickStopOption) {
      return value == cia402::kQuickStopRampThenOff || value == 6;
    }
    return address != object::kAbortConnectionOption || value <= cia402::kQuickStopOnLostMaster;
  }();
  return in_range ? std::nullopt : std::optional(SdoAbort::kValueRange);
}

std::optional<SdoAbort> SimDrive::mapping_refusal(ObjectAddress address, std::uint32_t value) const noexcept {
  const ObjectAddress count{address.index, 0};
  const ObjectAddress cob_id_object =
      address.index == object::kRpdo1Count.index ? object::kRpdo1CobId : object::kTpdo1CobId;
  const bool invalid = (objects_.get(cob_id_object) & cob_id::kPdoInvalid) != 0;
  if (!invalid || (address.sub != 0 && objects_.get(count) != 0)) {
    return SdoAbort::kAccess;
  }
  if (address.sub != 0) {
    const ObjectEntry* const mapped =
        objects_.find({static_cast<std::uint16_t>(value >> 16), static_cast<std::uint8_t>(value >> 8)});
    const bool possible = mapped != nullptr && mapped->mappable && (value & 0xFF) == mapped->bytes * 8U &&
                          (count == object::kTpdo1Count || mapped->access == ObjectAccess::kReadWrite);
    return possible ? std::nullopt : std::optional(SdoAbort::kNotMappable);
  }
  if (value > kSimMappingEntries) {
    return SdoAbort::kValueTooHigh;
  }
  std::uint32_t bits = 0;
  for (std::uint32_t n = 1; n <= value; ++n) {
    const std::uint32_t entry = objects_.get(object::mapping_entry(count, static_cast<std::uint8_t>(n)));
    if (entry == 0) {
      return SdoAbort::kNotMappable;
    }
    bits += entry & 0xFF;
  }
  return bits > 64 ? std::optional(SdoAbort::kPdoLength) : std::nullopt;
}

void SimDrive::written(ObjectAddress address, Outbox& out) noexcept {
  const std::uint32_t value = objects_.get(address);
  if (address == object::kConsumerHeartbeat) {
    master_ = HeartbeatConsumer(std::chrono::milliseconds(value & 0xFFFF));
  } else if (address == object::kProducerHeartbeat) {
    heartbeat_ = HeartbeatProducer(std::chrono::milliseconds(value));
  } else if (address == object::kModeOfOperation) {
    objects_.set(object::kModeDisplay, script_.refuse_mode ? 0 : value);
  } else if (address == object::kControlword) {
    command(static_cast<std::uint16_t>(value), out);
  }
}

}  // namespace ivo::drivers
