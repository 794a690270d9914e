#include "firmware/files/flat_yaml.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <utility>

namespace ivo::firmware {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Without its comment, which begins at a # after a blank that no quote encloses.
std::string_view uncommented(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool after_blank = i == 0 || kBlanks.find(line[i - 1]) != std::string_view::npos;
    if (quote != 0) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '#' && after_blank) {
      return line.substr(0, i);
    } else if ((c == '"' || c == '\'') && (after_blank || line[i - 1] == '[' || line[i - 1] == ',')) {
      quote = c;
    }
  }
  return line;
}

/// A plain or a quoted scalar, without escapes; none when it is something else.
std::optional<std::string> scalar_of(std::string_view text) {
  if (text.empty()) {
    return std::nullopt;
  }
  const char quote = text.front();
  if (quote == '"' || quote == '\'') {
    if (text.size() < 2 || text.back() != quote) {
      return std::nullopt;
    }
    text = text.substr(1, text.size() - 2);
    const bool odd = text.find(quote) != std::string_view::npos || (quote == '"' && text.find('\\') != text.npos);
    return odd ? std::nullopt : std::optional<std::string>(text);
  }
  // These begin or hold something that is no scalar, or no plain one.
  const bool odd = std::string_view("[]{}&*!|>%@`,?").find(quote) != std::string_view::npos ||
                   text.find(": ") != std::string_view::npos || text.back() == ':' || text.substr(0, 2) == "- ";
  return odd ? std::nullopt : std::optional<std::string>(text);
}

std::optional<YamlEntry> flow_list(std::string_view text, int line) {
  YamlEntry entry{line, true, {}};
  if (text.back() != ']') {
    return std::nullopt;
  }
  text = trimmed(text.substr(1, text.size() - 2));
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::optional<std::string> value = scalar_of(trimmed(text.substr(0, comma)));
    if (!value) {
      return std::nullopt;
    }
    entry.values.push_back(*value);
    text = comma < text.size() ? trimmed(text.substr(comma + 1)) : std::string_view{};
  }
  return entry;
}

bool any_control(std::string_view text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r'; });
}

std::string listed(std::initializer_list<std::string_view> keys) {
  std::string all;
  for (const std::string_view key : keys) {
    all.append(all.empty() ? "" : ", ").append(key);
  }
  return all;
}

}  // namespace

Result<FlatYaml> FlatYaml::parse(std::string_view text, const std::string& path,
                                 std::initializer_list<std::string_view> keys) {
  FlatYaml yaml(path);
  YamlEntry* open = nullptr;  // a key whose list comes line by line
  int number = 0;
  const auto refuse = [&](std::string_view what) {
    return Error{path + ":" + std::to_string(number) + ": " + std::string(what)};
  };
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view whole = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view line = trimmed(uncommented(whole));
    if (any_control(whole)) {
      return refuse("holds a control character; expected text");
    }
    if (line.empty() || (line == "---" && yaml.entries_.empty())) {
      continue;
    }
    if (line.substr(0, 2) == "- " && open != nullptr) {
      const std::optional<std::string> value = scalar_of(trimmed(line.substr(2)));
      if (!value) {
        return refuse("is no plain element of a list; expected a number or a text");
      }
      open->list = true;
      open->values.push_back(*value);
      continue;
    }
    if (open != nullptr && open->values.empty()) {
      return refuse("is no element of the list above; expected lines that begin with -");
    }
    open = nullptr;
    const std::size_t colon = line.find(':');
    if (kBlanks.find(whole.front()) != std::string_view::npos || colon == std::string_view::npos ||
        (colon + 1 < line.size() && kBlanks.find(line[colon + 1]) == std::string_view::npos)) {
      return refuse("is not KEY: VALUE at the line's beginning; expected a key a line, without tables");
    }
    const std::string key(trimmed(line.substr(0, colon)));
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      return refuse(std::string(key).append(": unknown; expected one of ") + listed(keys));
    }
    const std::string_view value = trimmed(line.substr(colon + 1));
    std::optional<YamlEntry> entry;
    if (value.empty()) {
      entry = YamlEntry{number, false, {}};
    } else if (value.front() == '[') {
      entry = flow_list(value, number);
    } else if (const std::optional<std::string> scalar = scalar_of(value)) {
      entry = YamlEntry{number, false, {*scalar}};
    }
    if (!entry) {
      return refuse(key + ": is neither a plain scalar nor a list of them; expected that on one line");
    }
    const auto [place, fresh] = yaml.entries_.emplace(key, *entry);
    if (!fresh) {
      return refuse(key + ": stands in line " + std::to_string(place->second.line) + " too; expected each key once");
    }
    open = value.empty() ? &place->second : nullptr;
  }
  if (open != nullptr && open->values.empty()) {
    return refuse("ends before the list that was begun; expected lines that begin with -");
  }
  return yaml;
}

const YamlEntry* FlatYaml::entry(std::string_view key) const {
  const auto found = entries_.find(key);
  return found == entries_.end() ? nullptr : &found->second;
}

Error FlatYaml::at(std::string_view key, std::string_view what) const {
  const YamlEntry* const found = entry(key);
  return Error{path_ + (found == nullptr ? "" : ":" + std::to_string(found->line)) + ": " + std::string(key) + ": " +
               std::string(what)};
}

std::optional<double> yaml_number(const std::string& text, double least, double most) {
  double value = 0.0;
  const char* const first = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char* const last = text.data() + text.size();
  const auto [end, status] = std::from_chars(first, last, value);
  const bool right = status == std::errc() && end == last && value >= least && value <= most;
  return right ? std::optional<double>(value) : std::nullopt;
}

}  // namespace ivo::firmware
