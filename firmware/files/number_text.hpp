// Numbers in messages and files: the shortest text that reads back as the same number.
#pragma once

#include <charconv>
#include <string>

namespace ivo::firmware {

[[nodiscard]] inline std::string shortest(double value) {
  char text[32];
  const auto [end, status] = std::to_chars(text, text + sizeof text, value);
  return {text, end};
}

}  // namespace ivo::firmware
