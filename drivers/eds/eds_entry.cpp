#include "drivers/eds/eds_entry.hpp"

#include <array>
#include <bit>

#include "drivers/eds/eds_number.hpp"

namespace ivo::drivers {
namespace {

/// By EdsAccess.
constexpr std::array<std::string_view, 6> kAccess = {"ro", "wo", "rw", "const", "rwr", "rww"};

bool crossed(const EdsObject& object) noexcept {
  if (!object.low.given || !object.high.given || object.low.plus_node != object.high.plus_node) {
    return false;
  }
  const std::uint64_t low = object.low.bits;
  const std::uint64_t high = object.high.bits;
  switch (object.type) {
    case DataType::kReal32:
      return std::bit_cast<float>(static_cast<std::uint32_t>(low)) >
             std::bit_cast<float>(static_cast<std::uint32_t>(high));
    case DataType::kReal64:
      return std::bit_cast<double>(low) > std::bit_cast<double>(high);
    default:
      return is_signed(object.type) ? static_cast<std::int64_t>(low) > static_cast<std::int64_t>(high) : low > high;
  }
}

}  // namespace

void EdsEntryReader::complain(EdsProblem problem, EdsKey key, DataType type) noexcept {
  if (!error_.has_value()) {
    const EdsField& field = fields_[key];
    error_ = EdsError{.problem = problem,
                      .line = field.line != 0 ? field.line : section_line_,
                      .section = {},
                      .key = ShortString<40>(name_of(key)),
                      .found = ShortString<60>(field.value),
                      .type = type,
                      .number = 0};
  }
}

void EdsEntryReader::require(EdsKey key) noexcept {
  if (!fields_[key].given()) {
    complain(EdsProblem::kMissingKey, key);
  }
}

std::uint64_t EdsEntryReader::number(EdsKey key, std::uint64_t most, std::uint64_t fallback) noexcept {
  if (!fields_[key].given()) {
    return fallback;
  }
  const EdsNumber number = eds_number(fields_[key].value, DataType::kUnsigned64);
  if (number.status == EdsNumberStatus::kNotANumber || number.value.plus_node) {
    complain(EdsProblem::kNotANumber, key);
  } else if (number.status == EdsNumberStatus::kOutOfRange || number.value.bits > most) {
    complain(EdsProblem::kNumberOutOfRange, key);
    if (error_.has_value()) {
      error_->number = most;
    }
  } else {
    return number.value.bits;
  }
  return fallback;
}

EdsObjectType EdsEntryReader::object_type() noexcept {
  const auto type = static_cast<EdsObjectType>(
      number(EdsKey::kObjectType, 0xFF, static_cast<std::uint64_t>(EdsObjectType::kVariable)));
  switch (type) {
    case EdsObjectType::kNull:
    case EdsObjectType::kDomain:
    case EdsObjectType::kDefType:
    case EdsObjectType::kDefStruct:
    case EdsObjectType::kVariable:
    case EdsObjectType::kArray:
    case EdsObjectType::kRecord:
      return type;
  }
  complain(EdsProblem::kUnknownObjectType, EdsKey::kObjectType);
  return EdsObjectType::kVariable;
}

EdsAccess EdsEntryReader::access() noexcept {
  for (std::size_t i = 0; i < kAccess.size(); ++i) {
    if (same_word(fields_[EdsKey::kAccessType].value, kAccess[i])) {
      return static_cast<EdsAccess>(i);
    }
  }
  complain(EdsProblem::kUnknownAccess, EdsKey::kAccessType);
  return EdsAccess::kReadOnly;
}

EdsValue EdsEntryReader::value(EdsKey key, DataType type) noexcept {
  if (!fields_[key].given() || !(is_signed(type) || is_unsigned(type) || is_real(type))) {
    return {};
  }
  const EdsNumber number = eds_number(fields_[key].value, type);
  if (number.status != EdsNumberStatus::kNumber) {
    complain(number.status == EdsNumberStatus::kNotANumber ? EdsProblem::kNotANumber : EdsProblem::kNumberOutOfRange,
             key, type);
  }
  return number.value;
}

EdsObject EdsEntryReader::entry(ObjectAddress address, bool domain) noexcept {
  EdsObject object;
  object.address = address;
  object.access = EdsAccess::kReadWrite;
  object.line = section_line_;
  require(EdsKey::kParameterName);
  if (domain) {
    object.type = DataType::kDomain;
  } else {
    require(EdsKey::kDataType);
    require(EdsKey::kAccessType);
    object.type = static_cast<DataType>(number(EdsKey::kDataType, 0xFFFF));
  }
  if (fields_[EdsKey::kAccessType].given()) {
    object.access = access();
  }
  object.mappable = number(EdsKey::kPdoMapping, 1) != 0;
  object.bytes = bytes_of(object.type);
  const EdsValue configured = value(EdsKey::kParameterValue, object.type);
  const EdsValue shipped = value(EdsKey::kDefaultValue, object.type);
  object.power_on = configured.given ? configured : shipped;
  object.low = value(EdsKey::kLowLimit, object.type);
  object.high = value(EdsKey::kHighLimit, object.type);
  if (crossed(object)) {
    complain(EdsProblem::kLimitsCrossed, EdsKey::kLowLimit);
  }
  return object;
}

}  // namespace ivo::drivers
