// The sentence of a finding about a drive's dictionary.
#pragma once

#include <string>

#include "drivers/eds/dictionary_check.hpp"

namespace ivo::drivers {

/// "6085h", or "1018h:1" where the sub-index is not 0.
[[nodiscard]] std::string text_of(ObjectAddress address);
/// "object 6085h is read-only; expected it writable, for \"quick stop deceleration 6085h\"".
[[nodiscard]] std::string describe(const DictionaryFinding& finding);

}  // namespace ivo::drivers
