#include "firmware/files/toml_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "firmware/files/key_advice.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {

struct TomlReading {
  struct Asked {
    const TomlNode* table = nullptr;
    std::vector<std::string> keys;
  };
  struct Fault {
    bool explained_by_others;  // a missing or misplaced key may be the trace of another fault
    int line;
    Error error;
    [[nodiscard]] auto order() const { return std::tie(explained_by_others, line); }
  };

  TomlNode root;
  Lines lines;
  std::map<std::string, Asked> asked;  // by path
  std::vector<Fault> faults;

  void add_fault(bool explained_by_others, std::string_view key_path, std::string_view what) {
    faults.push_back({explained_by_others, lines.line_of(key_path), lines.at(key_path, what)});
  }
};

namespace {

using Kind = TomlNode::Kind;

std::string joined(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

std::string indexed(const std::string& path, std::size_t i) { return path + "[" + std::to_string(i) + "]"; }

void collect_lines(const TomlNode& node, const std::string& path, std::map<std::string, int, std::less<>>& lines) {
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    const TomlNode& child = node.children[i];
    const std::string child_path = node.kind == Kind::kArray ? indexed(path, i) : joined(path, child.key);
    lines.emplace(child_path, child.line);
    collect_lines(child, child_path, lines);
  }
}

std::string described(const TomlNode& node) {
  switch (node.kind) {
    case Kind::kTable:
      return "is a table";
    case Kind::kArray:
      return "is a list";
    case Kind::kText:
      return "\"" + node.text + "\" is text";
    case Kind::kInteger:
      return std::to_string(node.integer) + " is a number";
    case Kind::kReal:
      return shortest(node.real) + (std::isfinite(node.real) ? " is a number" : " is not a finite number");
    case Kind::kFlag:
      return node.flag ? "true is a flag" : "false is a flag";
    case Kind::kDate:
      return "is a date or a time";
  }
  return "is unreadable";
}

std::string span_text(const Range& range) {
  std::string text = shortest(range.least) + " to " + shortest(range.most);
  return range.unit.empty() ? text : text + " (" + std::string(range.unit) + ")";
}

}  // namespace

const TomlNode* TomlValue::member(std::string_view key) const {
  if (node_ == nullptr) {
    return nullptr;
  }
  if (!is_table()) {
    complain_of_kind("a table");
    return nullptr;
  }
  auto& asked = reading_->asked[path_];
  asked.table = node_;
  if (std::find(asked.keys.begin(), asked.keys.end(), key) == asked.keys.end()) {
    asked.keys.emplace_back(key);
  }
  const auto found = std::find_if(node_->children.begin(), node_->children.end(),
                                  [&](const TomlNode& child) { return child.key == key; });
  return found == node_->children.end() ? nullptr : &*found;
}

std::string TomlValue::path_to(std::string_view key) const { return joined(path_, key); }

TomlValue TomlValue::optional(std::string_view key) const { return {*reading_, member(key), path_to(key)}; }

TomlValue TomlValue::required(std::string_view key) const {
  TomlValue value = optional(key);
  if (is_table() && !value.present()) {
    const std::string_view unit = unit_of(key);
    reading_->add_fault(
        true, value.path_,
        unit.empty() ? "missing; it must be given" : "missing; it must be given, in " + std::string(unit));
  }
  return value;
}

void TomlValue::refuse(std::string_view key, std::string_view what) const {
  if (member(key) != nullptr) {
    reading_->add_fault(true, path_to(key), what);
  }
}

void TomlValue::complain(std::string_view what) const { reading_->add_fault(false, path_, what); }

void TomlValue::complain_of_kind(std::string_view expected) const {
  complain(described(*node_) + "; expected " + std::string(expected));
}

double TomlValue::number(const Range& range, double fallback) const {
  if (node_ == nullptr) {
    return fallback;
  }
  if ((!is(Kind::kInteger) && !is(Kind::kReal)) || !std::isfinite(node_->real)) {
    complain_of_kind("a number, " + span_text(range));
    return fallback;
  }
  if (node_->real < range.least || node_->real > range.most) {
    complain(shortest(node_->real) + " is out of range; expected " + span_text(range));
    return fallback;
  }
  return node_->real;
}

std::int64_t TomlValue::integer(std::int64_t least, std::int64_t most, std::int64_t fallback) const {
  if (node_ == nullptr) {
    return fallback;
  }
  const std::string span = std::to_string(least) + " to " + std::to_string(most);
  if (!is(Kind::kInteger)) {
    complain_of_kind("a whole number, " + span);
    return fallback;
  }
  if (node_->integer < least || node_->integer > most) {
    complain(std::to_string(node_->integer) + " is out of range; expected " + span);
    return fallback;
  }
  return node_->integer;
}

bool TomlValue::flag(bool fallback) const {
  if (node_ == nullptr) {
    return fallback;
  }
  if (!is(Kind::kFlag)) {
    complain_of_kind("true or false");
    return fallback;
  }
  return node_->flag;
}

std::string TomlValue::text(std::string_view fallback) const {
  if (node_ == nullptr) {
    return std::string(fallback);
  }
  if (!is_text()) {
    complain_of_kind("text in quotes");
    return std::string(fallback);
  }
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (node_->text.empty()) {
    complain("is empty; expected text");
  } else if (std::any_of(node_->text.begin(), node_->text.end(), control)) {
    complain("holds a control character; expected plain text");
  }
  return node_->text;
}

std::size_t TomlValue::choice(std::initializer_list<std::string_view> words, std::size_t fallback) const {
  if (node_ == nullptr) {
    return fallback;
  }
  const auto* const found = std::find(words.begin(), words.end(), std::string_view(node_->text));
  if (is_text() && found != words.end()) {
    return static_cast<std::size_t>(found - words.begin());
  }
  std::string expected;
  for (const std::string_view word : words) {
    expected.append(expected.empty() ? "\"" : " or \"").append(word).append("\"");
  }
  if (is_text()) {
    complain("\"" + node_->text + "\" is unknown; expected " + expected);
  } else {
    complain_of_kind(expected);
  }
  return fallback;
}

Point TomlValue::point(const Range& range) const {
  const std::vector<TomlValue> xy = items(2, 2, "numbers, [x, y]");
  return xy.size() == 2 ? Point{xy[0].number(range), xy[1].number(range)} : Point{};
}

std::vector<TomlValue> TomlValue::items(std::size_t least, std::size_t most, std::string_view what) const {
  if (node_ == nullptr) {
    return {};
  }
  const std::string count =
      least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
  const std::string expected = "a list of " + count + " " + std::string(what);
  if (!is_list()) {
    complain_of_kind(expected);
    return {};
  }
  const std::size_t size = node_->children.size();
  if (size < least || size > most) {
    complain("has " + std::to_string(size) + (size == 1 ? " element" : " elements") + "; expected " + expected);
    return {};
  }
  std::vector<TomlValue> values;
  for (std::size_t i = 0; i < size; ++i) {
    values.push_back({*reading_, &node_->children[i], indexed(path_, i)});
  }
  return values;
}

TomlFile::TomlFile(std::unique_ptr<TomlReading> reading) : reading_(std::move(reading)) {}
TomlFile::TomlFile(TomlFile&&) noexcept = default;
TomlFile& TomlFile::operator=(TomlFile&&) noexcept = default;
TomlFile::~TomlFile() = default;

Result<TomlFile> TomlFile::read(const std::string& path) {
  const Result<std::string> text = read_file(path);
  if (!text) {
    return Error{text.error().message + "; expected a TOML file"};
  }
  return parse(text.value(), path);
}

Result<TomlFile> TomlFile::parse(std::string_view text, const std::string& path) {
  Result<TomlNode> root = parse_toml(text, path);
  if (!root) {
    return root.error();
  }
  auto reading = std::make_unique<TomlReading>();
  reading->root = std::move(root).value();
  std::map<std::string, int, std::less<>> lines;
  collect_lines(reading->root, "", lines);
  reading->lines = Lines(path, std::move(lines));
  return TomlFile(std::move(reading));
}

TomlValue TomlFile::root() const { return {*reading_, &reading_->root, ""}; }

const Lines& TomlFile::lines() const noexcept { return reading_->lines; }

Result<void> TomlFile::finish() const {
  std::vector<TomlReading::Fault> faults = reading_->faults;
  for (const auto& [path, asked] : reading_->asked) {
    for (const TomlNode& child : asked.table->children) {
      if (std::find(asked.keys.begin(), asked.keys.end(), child.key) == asked.keys.end()) {
        faults.push_back({false, child.line,
                          reading_->lines.at(joined(path, child.key), advice_on_unknown_key(child.key, asked.keys))});
      }
    }
  }
  const auto first = std::min_element(faults.begin(), faults.end(),
                                      [](const auto& a, const auto& b) { return a.order() < b.order(); });
  return first == faults.end() ? Result<void>() : Result<void>(first->error);
}

}  // namespace ivo::firmware
