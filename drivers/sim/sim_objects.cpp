#include "drivers/sim/sim_objects.hpp"

#include <cmath>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {
namespace {

constexpr ObjectAccess kReadOnly = ObjectAccess::kReadOnly;
constexpr ObjectAccess kReadWrite = ObjectAccess::kReadWrite;
constexpr double kRampRadps2 = 50.0;
constexpr double kQuickStopRampRadps2 = 100.0;
constexpr std::uint8_t kEventDriven = 255;

struct Object {
  ObjectAddress address;
  std::uint8_t bytes = 0;
  ObjectAccess access{};
  std::uint32_t value = 0;
};

void add(ObjectDictionary& objects, const Object& object) noexcept {
  objects.add({.address = object.address,
               .bytes = object.bytes,
               .access = object.access,
               .mappable = false,
               .default_value = object.value});
}

void add_mappable(ObjectDictionary& objects, ObjectAddress address, std::uint8_t bytes, ObjectAccess access) noexcept {
  objects.add({.address = address, .bytes = bytes, .access = access, .mappable = true, .default_value = 0});
}

void add_pdo(ObjectDictionary& objects, ObjectAddress cob_id_object, ObjectAddress count,
             std::uint32_t cob_id) noexcept {
  add(objects, {{cob_id_object.index, 0}, 1, kReadOnly, 2});
  add(objects, {cob_id_object, 4, kReadWrite, cob_id});
  add(objects, {{cob_id_object.index, 2}, 1, kReadWrite, kEventDriven});
  add(objects, {count, 1, kReadWrite, 0});
  for (std::uint8_t n = 1; n <= kSimMappingEntries; ++n) {
    add(objects, {object::mapping_entry(count, n), 4, kReadWrite, 0});
  }
}

void add_communication(ObjectDictionary& objects, const DriveParameters& drive, const SimScript& script) noexcept {
  add(objects, {object::kDeviceType, 4, kReadOnly, script.device_type});
  add(objects, {object::kErrorRegister, 1, kReadOnly, 0});
  add(objects, {object::kSyncCobId, 4, kReadWrite, cob_id::kSync});
  add(objects, {object::kCyclePeriod, 4, kReadWrite, 0});
  add(objects, {{object::kConsumerHeartbeat.index, 0}, 1, kReadOnly, 1});
  add(objects, {object::kConsumerHeartbeat, 4, kReadWrite, 0});
  add(objects, {object::kProducerHeartbeat, 2, kReadWrite, 0});
  add(objects, {{object::kVendorId.index, 0}, 1, kReadOnly, 2});
  add(objects, {object::kVendorId, 4, kReadOnly, drive.vendor_id});
  add(objects, {object::kProductCode, 4, kReadOnly, drive.product_code});
  add_pdo(objects, object::kRpdo1CobId, object::kRpdo1Count, cob_id::rpdo1(drive.node_id));
  add_pdo(objects, object::kTpdo1CobId, object::kTpdo1Count, cob_id::tpdo1(drive.node_id));
}

void add_profile(ObjectDictionary& objects, const DriveParameters& drive, const SimScript& script) noexcept {
  const auto ramp = [&drive](double radps2) {
    return static_cast<std::uint32_t>(std::llround(radps2 * drive.gear_ratio * drive.velocity_per_radps));
  };
  add(objects, {object::kAbortConnectionOption, 2, kReadWrite, 1});
  add(objects, {object::kErrorCode, 2, kReadOnly, 0});
  add_mappable(objects, object::kControlword, 2, kReadWrite);
  add_mappable(objects, object::kStatusword, 2, kReadOnly);
  add(objects, {object::kQuickStopOption, 2, kReadWrite, cia402::kQuickStopRampThenOff});
  add(objects, {object::kModeOfOperation, 1, kReadWrite, 0});
  add(objects, {object::kModeDisplay, 1, kReadOnly, 0});
  add_mappable(objects, object::kPositionActual, 4, kReadOnly);
  add_mappable(objects, object::kVelocityActual, 4, kReadOnly);
  add(objects, {object::kProfileAcceleration, 4, kReadWrite, ramp(kRampRadps2)});
  add(objects, {object::kProfileDeceleration, 4, kReadWrite, ramp(kRampRadps2)});
  add(objects, {object::kQuickStopDeceleration, 4, kReadWrite, ramp(kQuickStopRampRadps2)});
  add_mappable(objects, object::kTargetVelocity, 4, kReadWrite);
  add(objects, {object::kSupportedModes, 4, kReadOnly, script.supported_modes});
}

}  // namespace

ObjectDictionary sim_objects(const DriveParameters& drive, const SimScript& script) noexcept {
  ObjectDictionary objects;
  add_communication(objects, drive, script);
  add_profile(objects, drive, script);
  return objects;
}

}  // namespace ivo::drivers
