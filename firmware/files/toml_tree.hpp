// A TOML 1.0 document as a tree of plain values with their lines. Reading it with checks: toml_table.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.hpp"

namespace ivo::firmware {

struct TomlNode {
  enum class Kind : std::uint8_t { kTable, kArray, kText, kInteger, kReal, kFlag, kDate };

  Kind kind = Kind::kTable;
  int line = 1;                    ///< of the key; of the value in an array
  std::string key;                 ///< of a member of a table
  std::string text;                ///< kText
  std::int64_t integer = 0;        ///< kInteger
  double real = 0.0;               ///< kReal, and kInteger as a number
  bool flag = false;               ///< kFlag
  std::vector<TomlNode> children;  ///< members of a table, elements of an array, in the order of the file
};

/// The document's root table. A syntax error is one line, "PATH:LINE: not TOML: ...; expected TOML 1.0".
[[nodiscard]] Result<TomlNode> parse_toml(std::string_view text, const std::string& path);

}  // namespace ivo::firmware
