// The part of YAML that map_server's files are made of: a key a line, each with a scalar or a list of scalars. Anything
// else is refused by its line.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.hpp"

namespace ivo::firmware {

struct YamlEntry {
  int line = 1;
  bool list = false;                ///< "[a, b]", or "- a" in lines of its own
  std::vector<std::string> values;  ///< one of a scalar; without quotes
};

class FlatYaml {
 public:
  /// Refuses a key twice, tables in tables, anchors, tags, texts over several lines, and a key that is none of `keys`.
  [[nodiscard]] static Result<FlatYaml> parse(std::string_view text, const std::string& path,
                                              std::initializer_list<std::string_view> keys);

  /// Null without it.
  [[nodiscard]] const YamlEntry* entry(std::string_view key) const;
  /// "PATH:LINE: KEY: WHAT"; of a key that is not there without a line.
  [[nodiscard]] Error at(std::string_view key, std::string_view what) const;

 private:
  explicit FlatYaml(std::string path) : path_(std::move(path)) {}

  std::string path_;
  std::map<std::string, YamlEntry, std::less<>> entries_;
};

/// A number as YAML writes it, within both ends; none otherwise.
[[nodiscard]] std::optional<double> yaml_number(const std::string& text, double least, double most);

}  // namespace ivo::firmware
