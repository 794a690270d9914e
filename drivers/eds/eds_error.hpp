// Why an EDS was refused: where, and what was found. Plain data; its sentence is in eds_error_text.hpp.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/eds/data_type.hpp"
#include "drivers/eds/short_string.hpp"

namespace ivo::drivers {

enum class EdsProblem : std::uint8_t {
  kControlCharacter,   ///< a byte that is no text; number: the byte
  kLineTooLong,        ///< number: its bytes
  kNotALine,           ///< neither a section, nor a key with a value, nor a comment
  kSectionNotClosed,   ///< [ without ]
  kKeyOutsideSection,  ///< before the first section
  kDuplicateSection,   ///< number: line of the first
  kDuplicateKey,       ///< number: line of the first
  kMissingKey,         ///< `key` is not there
  kNotANumber,         ///< and must be one
  kNumberOutOfRange,   ///< of `type`, or of what the key may say
  kUnknownAccess,      ///< AccessType
  kUnknownObjectType,  ///< ObjectType
  kLimitsCrossed,      ///< LowLimit above HighLimit
  kWrongCount,         ///< of a list or of sub-indices; number: how many there are
  kListedTwice,        ///< number: line of the first
  kListedButMissing,   ///< an object of a list has no section
  kSubWithoutObject,   ///< no section of the object itself
  kSubOfVariable,      ///< the object is neither ARRAY nor RECORD
  kMissingSub,         ///< sub-index 0 of an ARRAY or RECORD
  kCompactWithSubs,    ///< CompactSubObj and sections of sub-indices
  kCompactValues,      ///< a section [xxxxValue]: not supported
  kTooManyObjects,     ///< beyond EdsDictionary::kObjects
  kTooMuchText,        ///< beyond EdsDictionary::kTextBytes
  kNoObjects,          ///< no section of an object with a value
};

struct EdsError {
  EdsProblem problem = EdsProblem::kNoObjects;
  std::uint32_t line = 0;  ///< from 1
  ShortString<40> section;
  ShortString<40> key;
  ShortString<60> found;
  DataType type = DataType::kNone;
  std::uint64_t number = 0;
};

}  // namespace ivo::drivers
