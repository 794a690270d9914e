// The sections of an EDS by their names, and the keys of one section that the reader knows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/canopen/object_address.hpp"
#include "drivers/eds/eds_lines.hpp"
#include "drivers/eds/short_string.hpp"

namespace ivo::drivers {

struct EdsSection {
  enum class Kind : std::uint8_t {
    kForeign,  ///< nothing that is read
    kDeviceInfo,
    kDummyUsage,
    kMandatoryObjects,
    kOptionalObjects,
    kManufacturerObjects,
    kObject,      ///< [1018]
    kSub,         ///< [1018sub1]
    kValueTable,  ///< [1018Value]: configured values of a compact object
    kNone,        ///< before the first section
  };
  Kind kind = Kind::kNone;
  ObjectAddress address;

  /// A list of objects: [MandatoryObjects] and its two like.
  [[nodiscard]] constexpr bool is_list() const noexcept {
    return kind >= Kind::kMandatoryObjects && kind <= Kind::kManufacturerObjects;
  }
  /// There can be one of it.
  [[nodiscard]] constexpr bool is_single() const noexcept {
    return kind >= Kind::kDeviceInfo && kind <= Kind::kManufacturerObjects;
  }
};

using SectionKind = EdsSection::Kind;

[[nodiscard]] EdsSection eds_section(std::string_view name) noexcept;
/// As an EDS names it: "1018sub1", or "1018" of the object itself.
[[nodiscard]] ShortString<40> section_name(ObjectAddress address, bool sub) noexcept;

enum class EdsKey : std::uint8_t {
  kParameterName,
  kObjectType,
  kDataType,
  kAccessType,
  kDefaultValue,
  kParameterValue,
  kLowLimit,
  kHighLimit,
  kPdoMapping,
  kSubNumber,
  kCompactSubObj,
  kVendorName,
  kVendorNumber,
  kProductName,
  kProductNumber,
  kRevisionNumber,
  kUnknown,
};
[[nodiscard]] std::string_view name_of(EdsKey key) noexcept;

struct EdsField {
  std::uint32_t line = 0;  ///< 0: not there
  std::string_view value;

  [[nodiscard]] bool given() const noexcept { return line != 0 && !value.empty(); }
};

class EdsFields {
 public:
  void clear() noexcept { fields_ = {}; }
  /// Keeps the value of a key that is known. The line where that key was already, or 0.
  [[nodiscard]] std::uint32_t take(const EdsLine& line) noexcept;
  [[nodiscard]] const EdsField& operator[](EdsKey key) const noexcept { return fields_[static_cast<std::size_t>(key)]; }

 private:
  std::array<EdsField, static_cast<std::size_t>(EdsKey::kUnknown) + 1> fields_{};
};

}  // namespace ivo::drivers
