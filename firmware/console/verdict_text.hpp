// A verdict in words for a person.
#pragma once

#include <string_view>

#include "firmware/console/console_messages.hpp"

namespace ivo::firmware::console {

/// As part of a sentence: "of a wrong size".
[[nodiscard]] std::string_view name_of(Verdict verdict) noexcept;

}  // namespace ivo::firmware::console
