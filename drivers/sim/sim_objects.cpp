#include "drivers/sim/sim_objects.hpp"

#include <array>
#include <cmath>
#include <span>

#include "config/base/contract.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {
namespace {

constexpr double kRampRadps2 = 50.0;
constexpr double kQuickStopRampRadps2 = 100.0;
constexpr std::size_t kMostNumberBytes = 4;

constexpr std::array<ObjectAddress, 9> kNeeded = {
    object::kDeviceType,  object::kErrorRegister,  object::kProducerHeartbeat,
    object::kControlword, object::kStatusword,     object::kModeOfOperation,
    object::kModeDisplay, object::kTargetVelocity, object::kSupportedModes};

bool is_number(const EdsObject& object) noexcept { return object.bytes >= 1 && object.bytes <= kMostNumberBytes; }

ObjectEntry entry_of(const EdsObject& object, std::uint8_t node_id) noexcept {
  ObjectEntry entry;
  entry.address = object.address;
  entry.bytes = object.bytes;
  entry.readable = readable(object.access);
  entry.writable = writable(object.access);
  entry.into_rpdo = object.mappable_into(true);
  entry.into_tpdo = object.mappable_into(false);
  entry.is_signed = is_signed(object.type);
  if (!is_real(object.type) && object.low.given) {
    entry.low = static_cast<std::int64_t>(object.low.at(node_id));
  }
  if (!is_real(object.type) && object.high.given) {
    entry.high = static_cast<std::int64_t>(object.high.at(node_id));
  }
  entry.default_value = static_cast<std::uint32_t>(object.power_on.at(object.power_on.given ? node_id : 0));
  return entry;
}

bool add_one(ObjectDictionary& objects, const EdsDictionary& eds, const EdsObject& object,
             std::uint8_t node_id) noexcept {
  const ObjectEntry entry = entry_of(object, node_id);
  if (is_number(object)) {
    return objects.add(entry);
  }
  if (object.bytes == 0) {
    const std::string_view text = eds.text_of(object);
    std::array<std::uint8_t, EdsDictionary::kStringBytes> content{};
    for (std::size_t i = 0; i < text.size(); ++i) {
      content[i] = static_cast<std::uint8_t>(text[i]);
    }
    return objects.add_long(entry, std::span(content).first(text.size()));
  }
  std::array<std::uint8_t, 8> content{};
  for (std::size_t i = 0; i < object.bytes; ++i) {
    content[i] = static_cast<std::uint8_t>(object.power_on.at(node_id) >> (8 * i));
  }
  return objects.add_long(entry, std::span(content).first(object.bytes));
}

/// `value` where the EDS leaves it open.
void fill(ObjectDictionary& objects, const EdsDictionary& eds, ObjectAddress address, std::uint32_t value) noexcept {
  const EdsObject* const object = eds.find(address);
  if (object != nullptr && object->power_on.bits == 0) {
    objects.set_default(address, value);
  }
}

}  // namespace

std::optional<SimUnfit> sim_unfit(const EdsDictionary& eds) noexcept {
  for (const ObjectAddress address : kNeeded) {
    const EdsObject* const object = eds.find(address);
    if (object == nullptr || !is_number(*object)) {
      return SimUnfit{.too_many = false, .missing = address};
    }
  }
  std::size_t longer = 0;
  for (const EdsObject& object : eds.objects()) {
    longer += is_number(object) ? 0 : 1;
  }
  if (eds.objects().size() > ObjectDictionary::kEntries || longer > ObjectDictionary::kLongObjects) {
    return SimUnfit{.too_many = true, .missing = {}};
  }
  return std::nullopt;
}

void add_sim_objects(ObjectDictionary& objects, const EdsDictionary& eds, const DriveParameters& drive,
                     const SimScript& script) noexcept {
  IVO_CONTRACT(!sim_unfit(eds).has_value());
  for (const EdsObject& object : eds.objects()) {
    IVO_CONTRACT(add_one(objects, eds, object, drive.node_id));
  }
  const auto ramp = [&drive](double radps2) {
    return static_cast<std::uint32_t>(std::llround(radps2 * drive.gear_ratio * drive.accel_per_radps2));
  };
  fill(objects, eds, object::kVendorId, drive.vendor_id);
  fill(objects, eds, object::kProductCode, drive.product_code);
  fill(objects, eds, object::kProfileAcceleration, ramp(kRampRadps2));
  fill(objects, eds, object::kProfileDeceleration, ramp(kRampRadps2));
  fill(objects, eds, object::kQuickStopDeceleration, ramp(kQuickStopRampRadps2));
  if (script.device_type.has_value()) {
    objects.set_default(object::kDeviceType, *script.device_type);
  }
  if (script.supported_modes.has_value()) {
    objects.set_default(object::kSupportedModes, *script.supported_modes);
  }
}

}  // namespace ivo::drivers
