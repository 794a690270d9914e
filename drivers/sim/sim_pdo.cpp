#include "drivers/sim/sim_pdo.hpp"

#include <chrono>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/eds/data_type.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint16_t kRpdoCommunication = 0x1400;
constexpr std::uint16_t kRpdoMapping = 0x1600;
constexpr std::uint16_t kTpdoCommunication = 0x1800;
constexpr std::uint16_t kTpdoMapping = 0x1A00;
constexpr std::uint8_t kCobIdSub = 1;
constexpr std::uint8_t kTypeSub = 2;
constexpr std::uint8_t kInhibitSub = 3;
constexpr std::uint8_t kTimerSub = 5;
constexpr std::uint32_t kIdAndFrameBits = 0x3FFF'FFFF;
constexpr std::uint32_t kExtendedFrame = 0x2000'0000;
constexpr std::uint32_t kPdoBits = 64;

bool in(std::uint16_t index, std::uint16_t first) noexcept { return index >= first && index < first + kSimPdos; }

SimMapped unpack(std::uint32_t entry) noexcept {
  return {{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8)},
          static_cast<std::uint8_t>((entry & 0xFF) / 8)};
}

/// COB-IDs that no PDO may have (CiA 301, 7.3.5).
bool restricted(std::uint32_t id) noexcept {
  return id <= 0x080 || (id >= 0x101 && id <= 0x180) || (id >= 0x581 && id <= 0x5FF) || (id >= 0x601 && id <= 0x67F) ||
         (id >= 0x6E0 && id <= 0x6FF) || id >= 0x701;
}

std::optional<SdoAbort> cob_id_refusal(std::uint32_t before, std::uint32_t after) noexcept {
  const bool was_valid = (before & cob_id::kPdoInvalid) == 0;
  const bool becomes_valid = (after & cob_id::kPdoInvalid) == 0;
  const bool another = ((before ^ after) & kIdAndFrameBits) != 0;
  const bool wrong = (after & kExtendedFrame) != 0 || (becomes_valid && restricted(after & 0x7FF));
  return wrong || (was_valid && becomes_valid && another) ? std::optional(SdoAbort::kValueRange) : std::nullopt;
}

std::optional<SdoAbort> communication_refusal(const ObjectDictionary& objects, ObjectAddress address,
                                              std::uint32_t value) noexcept {
  const std::uint32_t cob_id = objects.value_or({address.index, kCobIdSub}, cob_id::kPdoInvalid);
  if (address.sub == kCobIdSub) {
    return cob_id_refusal(cob_id, value);
  }
  if (address.sub == kTypeSub && value > 240 && value < 254) {
    return SdoAbort::kValueRange;
  }
  if (address.sub == kInhibitSub && (cob_id & cob_id::kPdoInvalid) == 0) {
    return SdoAbort::kAccess;
  }
  return std::nullopt;
}

bool mappable(const ObjectDictionary& objects, std::uint32_t entry, bool received, std::uint32_t dummies) noexcept {
  const SimMapped mapped = unpack(entry);
  if (mapped.dummy()) {
    const auto type = static_cast<DataType>(mapped.address.index);
    return received && mapped.address.sub == 0 && (dummies >> mapped.address.index & 1) != 0 &&
           (entry & 0xFF) == bytes_of(type) * 8U;
  }
  const ObjectEntry* const object = objects.find(mapped.address);
  return object != nullptr && (received ? object->into_rpdo : object->into_tpdo) &&
         (entry & 0xFF) == object->bytes * 8U;
}

std::optional<SdoAbort> mapping_refusal(const ObjectDictionary& objects, ObjectAddress address, std::uint32_t value,
                                        std::uint32_t dummies) noexcept {
  const bool received = in(address.index, kRpdoMapping);
  const auto communication = static_cast<std::uint16_t>(address.index - (kRpdoMapping - kRpdoCommunication));
  const bool invalid = (objects.value_or({communication, kCobIdSub}, cob_id::kPdoInvalid) & cob_id::kPdoInvalid) != 0;
  if (!invalid || (address.sub != 0 && objects.value_or({address.index, 0}, 0) != 0)) {
    return SdoAbort::kAccess;
  }
  if (address.sub != 0) {
    return value == 0 || mappable(objects, value, received, dummies) ? std::nullopt
                                                                     : std::optional(SdoAbort::kNotMappable);
  }
  std::uint32_t bits = 0;
  for (std::uint32_t n = 1; n <= value; ++n) {
    const std::uint32_t entry = objects.value_or({address.index, static_cast<std::uint8_t>(n)}, 0);
    if (entry == 0) {
      return SdoAbort::kNotMappable;
    }
    bits += entry & 0xFF;
  }
  return bits > kPdoBits ? std::optional(SdoAbort::kPdoLength) : std::nullopt;
}

}  // namespace

bool is_pdo_object(std::uint16_t index) noexcept {
  return in(index, kRpdoCommunication) || in(index, kRpdoMapping) || in(index, kTpdoCommunication) ||
         in(index, kTpdoMapping);
}

std::optional<SdoAbort> pdo_refusal(const ObjectDictionary& objects, ObjectAddress address, std::uint32_t value,
                                    std::uint32_t dummies) noexcept {
  const bool mapping = in(address.index, kRpdoMapping) || in(address.index, kTpdoMapping);
  return mapping ? mapping_refusal(objects, address, value, dummies) : communication_refusal(objects, address, value);
}

SimPdo sim_pdo(const ObjectDictionary& objects, std::size_t number, bool received) noexcept {
  const auto communication = static_cast<std::uint16_t>((received ? kRpdoCommunication : kTpdoCommunication) + number);
  const auto mapping = static_cast<std::uint16_t>((received ? kRpdoMapping : kTpdoMapping) + number);
  const auto value = [&](std::uint8_t sub, std::uint32_t fallback) {
    return objects.value_or({communication, sub}, fallback);
  };
  SimPdo pdo;
  const std::uint32_t cob_id = value(kCobIdSub, cob_id::kPdoInvalid);
  pdo.valid = (cob_id & cob_id::kPdoInvalid) == 0;
  pdo.cob_id = static_cast<std::uint16_t>(cob_id & 0x7FF);
  pdo.type = static_cast<std::uint8_t>(value(kTypeSub, 0xFF));
  pdo.inhibit = std::chrono::microseconds(100) * (received ? 0 : value(kInhibitSub, 0));
  pdo.timer = std::chrono::milliseconds(value(kTimerSub, 0));
  for (std::uint32_t n = 1; n <= objects.value_or({mapping, 0}, 0); ++n) {
    const SimMapped mapped = unpack(objects.value_or({mapping, static_cast<std::uint8_t>(n)}, 0));
    if (pdo.bytes + mapped.bytes > 8 || !pdo.mapped.push_back(mapped)) {
      break;
    }
    pdo.bytes = static_cast<std::uint8_t>(pdo.bytes + mapped.bytes);
  }
  return pdo;
}

void SimTpdo::configure(const SimPdo& pdo) noexcept {
  pdo_ = pdo;
  start();
}

void SimTpdo::start() noexcept {
  syncs_ = 0;
  last_.reset();
}

hal::CanFrame SimTpdo::content(const ObjectDictionary& objects) const noexcept {
  hal::CanFrame frame{.id = pdo_.cob_id, .size = 0, .data = {}};
  for (const SimMapped& mapped : pdo_.mapped) {
    const std::uint32_t value = objects.value_or(mapped.address, 0);
    for (std::size_t i = 0; i < mapped.bytes; ++i) {
      frame.data[frame.size++] = static_cast<std::uint8_t>(i < 4 ? value >> (8 * i) : 0);
    }
  }
  return frame;
}

hal::CanFrame SimTpdo::sent(const hal::CanFrame& frame, Instant now) noexcept {
  syncs_ = 0;
  last_ = frame;
  last_at_ = now;
  return frame;
}

std::optional<hal::CanFrame> SimTpdo::on_sync(const ObjectDictionary& objects, Instant now) noexcept {
  if (!pdo_.valid || !pdo_.synchronous() || (pdo_.type != 0 && ++syncs_ < pdo_.type)) {
    return std::nullopt;
  }
  const hal::CanFrame frame = content(objects);
  if (pdo_.type == 0 && last_ == frame) {
    return std::nullopt;  // acyclic: only what changed
  }
  return sent(frame, now);
}

std::optional<hal::CanFrame> SimTpdo::on_time(const ObjectDictionary& objects, Instant now) noexcept {
  if (!pdo_.valid || pdo_.synchronous() || (last_.has_value() && now - last_at_ < pdo_.inhibit)) {
    return std::nullopt;
  }
  const hal::CanFrame frame = content(objects);
  const bool timed_out = pdo_.timer > Duration::zero() && last_.has_value() && now - last_at_ >= pdo_.timer;
  return last_ == frame && !timed_out ? std::nullopt : std::optional(sent(frame, now));
}

}  // namespace ivo::drivers
