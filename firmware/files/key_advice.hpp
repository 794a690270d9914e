// What to tell a person whose file holds a key that nobody reads.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ivo::firmware {

/// "metres a second" for a key that ends in _mps; empty for a key without a unit.
[[nodiscard]] std::string_view unit_of(std::string_view key);

/// One line: the same quantity in the expected unit, else the nearest known key, else all of them.
[[nodiscard]] std::string advice_on_unknown_key(std::string_view key, const std::vector<std::string>& known);

}  // namespace ivo::firmware
