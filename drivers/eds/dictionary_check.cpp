#include "drivers/eds/dictionary_check.hpp"

#include <optional>

#include "drivers/canopen/cob_id.hpp"
#include "drivers/canopen/communication_objects.hpp"
#include "drivers/canopen/pdo.hpp"
#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/cia402/mode.hpp"
#include "drivers/cia402/objects.hpp"

namespace ivo::drivers {
namespace {

constexpr std::uint16_t kRpdoMapping = 0x1600;
constexpr std::uint16_t kTpdoMapping = 0x1A00;
constexpr std::uint16_t kMappings = 0x200;    // of each
constexpr std::uint16_t kFirstObject = 0x20;  // below are data types

using Finding = std::optional<DictionaryFinding>;

Finding finding(DictionaryProblem problem, const StartupStep& step, std::int64_t expected = 0,
                std::int64_t found = 0) noexcept {
  return DictionaryFinding{problem, step.object, step.name, expected, found};
}

bool writes(const StartupStep& step) noexcept {
  return step.action == StepAction::kWrite || step.action == StepAction::kWriteMode ||
         step.action == StepAction::kDisablePdo;
}

/// Of what is only for one of the modes: which of them 6502h would make start-up choose; none when it does not say.
bool left_out(const EdsDictionary& eds, const StartupStep& step) noexcept {
  const EdsObject* const modes = eds.find(object::kSupportedModes);
  const auto mode = modes != nullptr && !writable(modes->access)
                        ? cia402::velocity_mode(static_cast<std::uint32_t>(modes->power_on.bits))
                        : std::nullopt;
  return mode.has_value() &&
         ((step.mode == StepMode::kProfileVelocity && *mode != cia402::Mode::kProfileVelocity) ||
          (step.mode == StepMode::kCyclicSynchronousVelocity && *mode != cia402::Mode::kCyclicSynchronousVelocity));
}

bool is_mapping(ObjectAddress address, std::uint16_t first) noexcept {
  return address.index >= first && address.index < first + kMappings && address.sub != 0;
}

/// As a number of the object's type.
std::int64_t number_of(const EdsObject& object, std::uint32_t value) noexcept {
  const std::uint32_t low = low_bytes(value, object.bytes);
  if (!is_signed(object.type)) {
    return low;
  }
  const int unused = 64 - 8 * object.bytes;
  return static_cast<std::int64_t>(std::uint64_t{low} << unused) >> unused;
}

Finding check_limits(const EdsObject& object, const StartupStep& step, std::uint8_t node_id) noexcept {
  if (step.action != StepAction::kWrite || !(is_signed(object.type) || is_unsigned(object.type))) {
    return std::nullopt;
  }
  const std::int64_t value = number_of(object, step.value);
  const auto low = static_cast<std::int64_t>(object.low.at(node_id));
  const auto high = static_cast<std::int64_t>(object.high.at(node_id));
  if (object.low.given && value < low) {
    return finding(DictionaryProblem::kTooLow, step, value, low);
  }
  return object.high.given && value > high ? finding(DictionaryProblem::kTooHigh, step, value, high) : std::nullopt;
}

bool mappable(const EdsDictionary& eds, std::uint32_t entry, bool received) noexcept {
  const ObjectAddress mapped{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8)};
  const std::uint32_t bits = entry & 0xFF;
  const auto type = static_cast<DataType>(mapped.index);
  if (mapped.index < kFirstObject) {
    return received && eds.dummy(type) && bits == bytes_of(type) * 8U;
  }
  const EdsObject* const object = eds.find(mapped);
  return object != nullptr && object->mappable_into(received) && bits == object->bits();
}

Finding check_mapped(const EdsDictionary& eds, const StartupStep& step) noexcept {
  const bool received = is_mapping(step.object, kRpdoMapping);
  if (step.action != StepAction::kWrite || !(received || is_mapping(step.object, kTpdoMapping))) {
    return std::nullopt;
  }
  const bool fits =
      mappable(eds, step.value, received) || (step.alternative != 0 && mappable(eds, step.alternative, received));
  return fits ? std::nullopt : finding(DictionaryProblem::kNotMappable, step, step.value);
}

/// Start-up would find a PDO of that role that is right as it is, or can be made so without its mapping
/// (pdo_search.hpp).
bool right_as_it_is(const EdsDictionary& eds, PdoRole role, std::uint8_t node_id) noexcept {
  const bool command = role == PdoRole::kCommand;
  const std::uint32_t first = object::mapped(command ? object::kControlword : object::kStatusword, 16);
  const std::uint32_t second = object::mapped(command ? object::kTargetVelocity : object::kPositionActual, 32);
  const auto is = [&](ObjectAddress address, std::uint64_t value, bool may_be_written) {
    const EdsObject* const object = eds.find(address);
    return object != nullptr && (object->power_on.at(node_id) == value || (may_be_written && writable(object->access)));
  };
  for (std::uint8_t number = 1; number <= cob_id::kPdos; ++number) {
    const ObjectAddress count = command ? object::rpdo_count(number) : object::tpdo_count(number);
    const ObjectAddress type = command ? object::rpdo_type(number) : object::tpdo_type(number);
    const ObjectAddress id = command ? object::rpdo_cob_id(number) : object::tpdo_cob_id(number);
    const std::uint32_t wished = command ? cob_id::rpdo(number, node_id) : cob_id::tpdo(number, node_id);
    const bool id_right = is(id, wished, true) || is(id, wished | cob_id::kPdoNoRemote, false);
    if (is(object::mapping_entry(count, 1), first, false) && is(object::mapping_entry(count, 2), second, false) &&
        is(count, 2, true) && is(type, kEverySync, true) && id_right) {
      return true;
    }
  }
  return false;
}

Finding check_constant(const EdsObject& object, const StartupStep& step) noexcept {
  if (writable(object.access) || !object.power_on.given || object.power_on.bits == 0) {
    return std::nullopt;
  }
  const auto value = static_cast<std::uint32_t>(object.power_on.bits);
  const bool alternative = step.alternative != 0 && (value & step.mask) == step.alternative;
  if (step.action == StepAction::kVerify && (value & step.mask) != step.value && !alternative) {
    return finding(DictionaryProblem::kOtherValue, step, step.value, value & step.mask);
  }
  const bool no_mode = step.action == StepAction::kChooseMode && !cia402::velocity_mode(value).has_value();
  return no_mode ? finding(DictionaryProblem::kNoMode, step, 0, value) : std::nullopt;
}

Finding check_step(const EdsDictionary& eds, const StartupStep& step, std::uint8_t node_id) noexcept {
  const EdsObject* const object = eds.find(step.object);
  if (object == nullptr) {
    return step.may_be_missing ? std::nullopt : finding(DictionaryProblem::kMissing, step);
  }
  if (object->bytes != step.bytes) {
    return finding(DictionaryProblem::kSize, step, step.bytes, object->bytes);
  }
  if (writes(step) && !writable(object->access)) {
    return finding(DictionaryProblem::kReadOnly, step);
  }
  if (!writes(step) && !readable(object->access)) {
    return finding(DictionaryProblem::kWriteOnly, step);
  }
  if (const Finding limits = check_limits(*object, step, node_id)) {
    return limits;
  }
  const Finding mapped = check_mapped(eds, step);
  return mapped.has_value() ? mapped : check_constant(*object, step);
}

}  // namespace

DictionaryFindings check_dictionary(const EdsDictionary& eds, const StartupSteps& steps,
                                    std::uint8_t node_id) noexcept {
  DictionaryFindings findings;
  const bool command = right_as_it_is(eds, PdoRole::kCommand, node_id);
  const bool feedback = right_as_it_is(eds, PdoRole::kFeedback, node_id);
  for (const StartupStep& step : steps) {
    const bool searched = (step.role == PdoRole::kCommand && command) || (step.role == PdoRole::kFeedback && feedback);
    if (step.may_refuse || searched || left_out(eds, step)) {
      continue;
    }
    if (const Finding found = check_step(eds, step, node_id); found.has_value() && !findings.push_back(*found)) {
      break;
    }
  }
  return findings;
}

}  // namespace ivo::drivers
