// The only file that includes toml++, which takes seconds to compile.
#include "firmware/files/toml_tree.hpp"

#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <algorithm>

namespace ivo::firmware {
namespace {

int line_of(const toml::source_region& source) { return std::max(1, static_cast<int>(source.begin.line)); }

TomlNode converted(const toml::node& from) {
  using Kind = TomlNode::Kind;
  TomlNode node;
  node.line = line_of(from.source());
  if (const auto* table = from.as_table()) {
    node.kind = Kind::kTable;
    for (const auto& [key, value] : *table) {
      TomlNode child = converted(value);
      child.key = std::string(key.str());
      // A table's own line is its header; a key written with dots has none of its own.
      if (!value.is_table() && !value.is_array_of_tables()) {
        child.line = line_of(key.source());
      }
      node.children.push_back(std::move(child));
    }
    std::stable_sort(node.children.begin(), node.children.end(),
                     [](const TomlNode& a, const TomlNode& b) { return a.line < b.line; });
  } else if (const auto* array = from.as_array()) {
    node.kind = Kind::kArray;
    for (const auto& value : *array) {
      node.children.push_back(converted(value));
    }
  } else if (const auto* text = from.as_string()) {
    node.kind = Kind::kText;
    node.text = text->get();
  } else if (const auto* integer = from.as_integer()) {
    node.kind = Kind::kInteger;
    node.integer = integer->get();
    node.real = static_cast<double>(node.integer);
  } else if (const auto* real = from.as_floating_point()) {
    node.kind = Kind::kReal;
    node.real = real->get();
  } else if (const auto* flag = from.as_boolean()) {
    node.kind = Kind::kFlag;
    node.flag = flag->get();
  } else {
    node.kind = Kind::kDate;
  }
  return node;
}

std::string on_one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return line;
}

}  // namespace

Result<TomlNode> parse_toml(std::string_view text, const std::string& path) {
  const toml::parse_result parsed = toml::parse(text, path);
  if (!parsed) {
    const toml::parse_error& error = parsed.error();
    return Error{path + ":" + std::to_string(line_of(error.source())) +
                 ": not TOML: " + on_one_line(error.description()) + "; expected TOML 1.0"};
  }
  return converted(parsed.table());
}

}  // namespace ivo::firmware
