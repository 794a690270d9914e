// Numbers in messages: the shortest text that reads back as the same number, without an exponent where people would not
// write one.
#pragma once

#include <charconv>
#include <cmath>
#include <string>

#include "config/base/geometry.hpp"

namespace ivo::firmware {

[[nodiscard]] inline std::string shortest(double value) {
  char text[32];
  const double size = std::abs(value);
  const bool plain = value == 0 || (size >= 1e-7 && size < 1e15);
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  const auto [end, status] = std::to_chars(text, text + sizeof text, value, format);
  return {text, end};
}

/// "(1.5, 2)"
[[nodiscard]] inline std::string shortest(Point p) { return "(" + shortest(p.x_m) + ", " + shortest(p.y_m) + ")"; }

}  // namespace ivo::firmware
