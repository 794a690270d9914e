#include "drivers/eds/eds_section.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "drivers/eds/eds_number.hpp"

namespace ivo::drivers {
namespace {

struct Named {
  std::string_view name;
  SectionKind kind;
};
constexpr std::array<Named, 5> kSections = {{{"DeviceInfo", SectionKind::kDeviceInfo},
                                             {"DummyUsage", SectionKind::kDummyUsage},
                                             {"MandatoryObjects", SectionKind::kMandatoryObjects},
                                             {"OptionalObjects", SectionKind::kOptionalObjects},
                                             {"ManufacturerObjects", SectionKind::kManufacturerObjects}}};

constexpr std::array<std::string_view, static_cast<std::size_t>(EdsKey::kUnknown)> kKeys = {
    "ParameterName", "ObjectType",  "DataType",      "AccessType",    "DefaultValue",  "ParameterValue",
    "LowLimit",      "HighLimit",   "PDOMapping",    "SubNumber",     "CompactSubObj", "VendorName",
    "VendorNumber",  "ProductName", "ProductNumber", "RevisionNumber"};

std::optional<std::uint32_t> hexadecimal(std::string_view text) noexcept {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return !text.empty() && error == std::errc() && end == text.data() + text.size() ? std::optional(value)
                                                                                   : std::nullopt;
}

}  // namespace

EdsSection eds_section(std::string_view name) noexcept {
  for (const Named& section : kSections) {
    if (same_word(name, section.name)) {
      return {section.kind, {}};
    }
  }
  constexpr std::size_t kIndexDigits = 4;
  const std::optional<std::uint32_t> index = hexadecimal(name.substr(0, std::min(kIndexDigits, name.size())));
  if (name.size() < kIndexDigits || !index.has_value()) {
    return {SectionKind::kForeign, {}};
  }
  const ObjectAddress address{static_cast<std::uint16_t>(*index), 0};
  const std::string_view rest = name.substr(kIndexDigits);
  if (rest.empty()) {
    return {SectionKind::kObject, address};
  }
  constexpr std::string_view kSub = "sub";
  if (starts_with_word(rest, kSub)) {
    const std::optional<std::uint32_t> sub = hexadecimal(rest.substr(kSub.size()));
    if (sub.has_value() && *sub <= 0xFF && rest.size() <= kSub.size() + 2) {
      return {SectionKind::kSub, {address.index, static_cast<std::uint8_t>(*sub)}};
    }
  }
  return {same_word(rest, "Value") ? SectionKind::kValueTable : SectionKind::kForeign, address};
}

ShortString<40> section_name(ObjectAddress address, bool sub) noexcept {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::array<char, 9> name{};
  std::size_t size = 0;
  for (int shift = 12; shift >= 0; shift -= 4) {
    name[size++] = kDigits[address.index >> shift & 0xF];
  }
  if (sub) {
    for (const char c : std::string_view("sub")) {
      name[size++] = c;
    }
    if (address.sub > 0xF) {
      name[size++] = kDigits[address.sub >> 4];
    }
    name[size++] = kDigits[address.sub & 0xF];
  }
  return ShortString<40>({name.data(), size});
}

std::string_view name_of(EdsKey key) noexcept {
  return key == EdsKey::kUnknown ? std::string_view() : kKeys[static_cast<std::size_t>(key)];
}

std::uint32_t EdsFields::take(const EdsLine& line) noexcept {
  const auto* const key =
      std::find_if(kKeys.begin(), kKeys.end(), [&](std::string_view name) { return same_word(name, line.name); });
  if (key == kKeys.end()) {
    return 0;
  }
  EdsField& field = fields_[static_cast<std::size_t>(key - kKeys.begin())];
  if (field.line != 0) {
    return field.line;
  }
  field = {line.number, line.value};
  return 0;
}

}  // namespace ivo::drivers
