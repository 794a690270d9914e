#include "drivers/eds/data_type.hpp"

#include <limits>

namespace ivo::drivers {
namespace {

enum class Kind : std::uint8_t { kOther, kSigned, kUnsigned, kReal, kText };

struct Traits {
  Kind kind = Kind::kOther;
  std::uint8_t bytes = 0;
};

Traits traits(DataType type) noexcept {
  switch (type) {
    case DataType::kBoolean:
    case DataType::kUnsigned8:
      return {Kind::kUnsigned, 1};
    case DataType::kUnsigned16:
      return {Kind::kUnsigned, 2};
    case DataType::kUnsigned24:
      return {Kind::kUnsigned, 3};
    case DataType::kUnsigned32:
      return {Kind::kUnsigned, 4};
    case DataType::kUnsigned40:
      return {Kind::kUnsigned, 5};
    case DataType::kUnsigned48:
      return {Kind::kUnsigned, 6};
    case DataType::kUnsigned56:
      return {Kind::kUnsigned, 7};
    case DataType::kUnsigned64:
      return {Kind::kUnsigned, 8};
    case DataType::kInteger8:
      return {Kind::kSigned, 1};
    case DataType::kInteger16:
      return {Kind::kSigned, 2};
    case DataType::kInteger24:
      return {Kind::kSigned, 3};
    case DataType::kInteger32:
      return {Kind::kSigned, 4};
    case DataType::kInteger40:
      return {Kind::kSigned, 5};
    case DataType::kInteger48:
      return {Kind::kSigned, 6};
    case DataType::kInteger56:
      return {Kind::kSigned, 7};
    case DataType::kInteger64:
      return {Kind::kSigned, 8};
    case DataType::kReal32:
      return {Kind::kReal, 4};
    case DataType::kReal64:
      return {Kind::kReal, 8};
    case DataType::kTimeOfDay:
    case DataType::kTimeDifference:
      return {Kind::kOther, 6};
    case DataType::kVisibleString:
    case DataType::kOctetString:
    case DataType::kUnicodeString:
      return {Kind::kText, 0};
    case DataType::kNone:
    case DataType::kDomain:
      break;
  }
  return {};
}

}  // namespace

std::uint8_t bytes_of(DataType type) noexcept { return traits(type).bytes; }
bool is_signed(DataType type) noexcept { return traits(type).kind == Kind::kSigned; }
bool is_unsigned(DataType type) noexcept { return traits(type).kind == Kind::kUnsigned; }
bool is_real(DataType type) noexcept { return traits(type).kind == Kind::kReal; }
bool is_text(DataType type) noexcept { return traits(type).kind == Kind::kText; }

std::int64_t least_of(DataType type) noexcept {
  return is_signed(type) ? std::numeric_limits<std::int64_t>::min() >> (64 - 8 * bytes_of(type)) : 0;
}

std::uint64_t most_of(DataType type) noexcept {
  if (type == DataType::kBoolean) {
    return 1;
  }
  if (!is_signed(type) && !is_unsigned(type)) {
    return 0;
  }
  return std::numeric_limits<std::uint64_t>::max() >> (64 - 8 * bytes_of(type) + (is_signed(type) ? 1 : 0));
}

}  // namespace ivo::drivers
