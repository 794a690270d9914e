#include "drivers/eds/dictionary_check.hpp"

#include <optional>

#include "drivers/canopen/sdo_frame.hpp"
#include "drivers/cia402/mode.hpp"

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
  return step.action == StepAction::kWrite || step.action == StepAction::kWriteMode;
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

Finding check_mapped(const EdsDictionary& eds, const StartupStep& step) noexcept {
  const bool received = is_mapping(step.object, kRpdoMapping);
  if (step.action != StepAction::kWrite || !(received || is_mapping(step.object, kTpdoMapping))) {
    return std::nullopt;
  }
  const ObjectAddress mapped{static_cast<std::uint16_t>(step.value >> 16), static_cast<std::uint8_t>(step.value >> 8)};
  const std::uint32_t bits = step.value & 0xFF;
  const EdsObject* const object = eds.find(mapped);
  const auto type = static_cast<DataType>(mapped.index);
  const bool fits = mapped.index < kFirstObject
                        ? received && eds.dummy(type) && bits == bytes_of(type) * 8U
                        : object != nullptr && object->mappable_into(received) && bits == object->bits();
  return fits ? std::nullopt : finding(DictionaryProblem::kNotMappable, step, step.value);
}

Finding check_constant(const EdsObject& object, const StartupStep& step) noexcept {
  if (writable(object.access) || !object.power_on.given || object.power_on.bits == 0) {
    return std::nullopt;
  }
  const auto value = static_cast<std::uint32_t>(object.power_on.bits);
  if (step.action == StepAction::kVerify && (value & step.mask) != step.value) {
    return finding(DictionaryProblem::kOtherValue, step, step.value, value & step.mask);
  }
  const bool no_mode = step.action == StepAction::kChooseMode && !cia402::velocity_mode(value).has_value();
  return no_mode ? finding(DictionaryProblem::kNoMode, step, 0, value) : std::nullopt;
}

Finding check_step(const EdsDictionary& eds, const StartupStep& step, std::uint8_t node_id) noexcept {
  const EdsObject* const object = eds.find(step.object);
  if (object == nullptr) {
    return finding(DictionaryProblem::kMissing, step);
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
  for (const StartupStep& step : steps) {
    if (step.may_refuse) {
      continue;
    }
    if (const Finding found = check_step(eds, step, node_id); found.has_value() && !findings.push_back(*found)) {
      break;
    }
  }
  return findings;
}

}  // namespace ivo::drivers
