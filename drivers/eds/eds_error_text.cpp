#include "drivers/eds/eds_error_text.hpp"

#include "drivers/eds/eds_dictionary.hpp"
#include "drivers/eds/eds_lines.hpp"

namespace ivo::drivers {
namespace {

std::string printable(std::string_view text) {
  std::string shown(text);
  for (char& c : shown) {
    c = c >= ' ' && c <= '~' ? c : '?';
  }
  return shown;
}

std::string quoted(std::string_view text) { return "\"" + printable(text) + "\""; }

std::string name_of(DataType type) {
  const std::string bits = std::to_string(8 * bytes_of(type));
  if (type == DataType::kBoolean) {
    return "BOOLEAN";
  }
  return (is_real(type) ? "REAL" : is_signed(type) ? "INTEGER" : "UNSIGNED") + bits;
}

std::string range_of(const EdsError& error) {
  if (is_real(error.type)) {
    return " does not fit " + name_of(error.type) + "; expected a number in its range";
  }
  if (error.type == DataType::kNone) {
    return " is too large; expected 0 to " + std::to_string(error.number);
  }
  return " does not fit " + name_of(error.type) + "; expected " + std::to_string(least_of(error.type)) + " to " +
         std::to_string(most_of(error.type));
}

std::string what(const EdsError& error) {
  const std::string number = std::to_string(error.number);
  const std::string found = quoted(error.found.view());
  switch (error.problem) {
    case EdsProblem::kControlCharacter:
      return "byte " + number + " in the line; expected text";
    case EdsProblem::kLineTooLong:
      return "the line has " + number + " bytes; expected at most " + std::to_string(EdsLines::kLineBytes);
    case EdsProblem::kNotALine:
      return found + "; expected [section], key=value or a comment that begins with ;";
    case EdsProblem::kSectionNotClosed:
      return found + "; expected ] at its end";
    case EdsProblem::kKeyOutsideSection:
      return "the key is before any section; expected [section] first";
    case EdsProblem::kDuplicateSection:
      return "the section is there already, on line " + number + "; expected it once";
    case EdsProblem::kDuplicateKey:
      return "the key is there already, on line " + number + "; expected it once";
    case EdsProblem::kMissingKey:
      return "missing; expected a value";
    case EdsProblem::kNotANumber:
      return found + " is no number; expected decimal, 0x and hexadecimal, or 0 and octal" +
             (is_unsigned(error.type) ? ", also with $NODEID+" : "");
    case EdsProblem::kNumberOutOfRange:
      return found + range_of(error);
    case EdsProblem::kUnknownAccess:
      return found + "; expected ro, wo, rw, rwr, rww or const";
    case EdsProblem::kUnknownObjectType:
      return found + "; expected 7 (VAR), 8 (ARRAY), 9 (RECORD), 2 (DOMAIN), 5, 6 or 0";
    case EdsProblem::kLimitsCrossed:
      return found + " is above HighLimit; expected at most that";
    case EdsProblem::kWrongCount:
      return "there are " + number + "; expected as many as it says";
    case EdsProblem::kListedTwice:
      return "the object is listed already, on line " + number + "; expected it once";
    case EdsProblem::kListedButMissing:
      return "the object is listed but has no section; expected one";
    case EdsProblem::kSubWithoutObject:
      return "the object itself has no section; expected one";
    case EdsProblem::kSubOfVariable:
      return "the object is a variable; expected ObjectType 8 or 9 of what has sub-indices";
    case EdsProblem::kMissingSub:
      return "sub-index 0 is missing; expected its section";
    case EdsProblem::kCompactWithSubs:
      return "CompactSubObj and sections of sub-indices; expected one of both";
    case EdsProblem::kCompactValues:
      return "tables of values are not supported; expected ParameterValue in sections of the sub-indices";
    case EdsProblem::kTooManyObjects:
      return "one object too many; expected at most " + std::to_string(EdsDictionary::kObjects);
    case EdsProblem::kTooMuchText:
      return "names and strings are too long together; expected at most " + std::to_string(EdsDictionary::kTextBytes) +
             " bytes";
    case EdsProblem::kNoObjects:
      return "no object is described; expected sections as [1000]";
  }
  return "wrong";
}

}  // namespace

std::string describe(const EdsError& error) {
  std::string place = error.section.view().empty() ? "" : "[" + printable(error.section.view()) + "]";
  if (!error.key.view().empty()) {
    place += (place.empty() ? "" : " ") + printable(error.key.view());
  }
  return (place.empty() ? "" : place + ": ") + what(error);
}

}  // namespace ivo::drivers
