// Whether a drive, as its EDS describes it, has what start-up will read and write.
#pragma once

#include <cstdint>

#include "config/base/static_vector.hpp"
#include "drivers/canopen/object_address.hpp"
#include "drivers/eds/eds_dictionary.hpp"
#include "drivers/startup_steps.hpp"

namespace ivo::drivers {

enum class DictionaryProblem : std::uint8_t {
  kMissing,
  kSize,         ///< expected, found: bytes
  kReadOnly,     ///< and must be written
  kWriteOnly,    ///< and must be read
  kTooLow,       ///< expected: what is written; found: LowLimit
  kTooHigh,      ///< expected: what is written; found: HighLimit
  kNotMappable,  ///< into the PDO that `step` is of
  kOtherValue,   ///< a constant; expected, found
  kNoMode,       ///< 6502h offers no velocity mode; found: what it says
};

struct DictionaryFinding {
  DictionaryProblem problem{};
  ObjectAddress object;
  const char* step = "";  ///< of start-up
  std::int64_t expected = 0;
  std::int64_t found = 0;
};

/// In the order of start-up, at most one a step; the first kFindings of them.
inline constexpr std::size_t kFindings = 32;
using DictionaryFindings = StaticVector<DictionaryFinding, kFindings>;

/// What a drive may refuse is not looked at, nor what is for another mode than its own; PDOs need not be mappable where
/// one of the drive's is right as it is (pdo_search.hpp). Cost: a search in the table for each step.
[[nodiscard]] DictionaryFindings check_dictionary(const EdsDictionary& eds, const StartupSteps& steps,
                                                  std::uint8_t node_id) noexcept;

}  // namespace ivo::drivers
