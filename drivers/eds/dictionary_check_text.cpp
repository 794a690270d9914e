#include "drivers/eds/dictionary_check_text.hpp"

#include <string_view>

namespace ivo::drivers {
namespace {

std::string hexadecimal(std::uint64_t value, int digits) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) {
    text += kDigits[value >> shift & 0xF];
  }
  return text + "h";
}

std::string long_word(std::int64_t value) { return hexadecimal(static_cast<std::uint64_t>(value), 8); }

std::string what(const DictionaryFinding& finding) {
  const std::string expected = std::to_string(finding.expected);
  const std::string found = std::to_string(finding.found);
  switch (finding.problem) {
    case DictionaryProblem::kMissing:
      return "is missing; expected it";
    case DictionaryProblem::kSize:
      return "has " + found + " bytes; expected " + expected;
    case DictionaryProblem::kReadOnly:
      return "is read-only; expected it writable";
    case DictionaryProblem::kWriteOnly:
      return "is write-only; expected it readable";
    case DictionaryProblem::kTooLow:
      return "takes no less than " + found + "; expected it to take " + expected;
    case DictionaryProblem::kTooHigh:
      return "takes no more than " + found + "; expected it to take " + expected;
    case DictionaryProblem::kNotMappable: {
      const auto entry = static_cast<std::uint32_t>(finding.expected);
      return "is to map " + text_of({static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8)}) +
             " with " + std::to_string(entry & 0xFF) + " bits; expected it mappable so";
    }
    case DictionaryProblem::kOtherValue:
      return "is always " + long_word(finding.found) + "; expected " + long_word(finding.expected);
    case DictionaryProblem::kNoMode:
      return "is always " + long_word(finding.found) + "; expected a velocity mode, bit 2 or bit 8";
  }
  return "is wrong";
}

}  // namespace

std::string text_of(ObjectAddress address) {
  return hexadecimal(address.index, 4) + (address.sub != 0 ? ":" + std::to_string(address.sub) : "");
}

std::string describe(const DictionaryFinding& finding) {
  return "object " + text_of(finding.object) + " " + what(finding) + ", for \"" + finding.step + "\"";
}

}  // namespace ivo::drivers
