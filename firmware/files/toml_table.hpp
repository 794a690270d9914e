// Typed, checked reading of a TOML file. A reader asks for what it needs, gets a value each time (the fallback when
// there is trouble) and asks once at the end whether the file was right: TomlFile::finish names the first fault as
// "FILE:LINE: KEY: what was wrong; what is expected". Keys that nobody asked for are faults too.
// Start-up only: strings and heap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "firmware/files/lines.hpp"
#include "firmware/files/toml_tree.hpp"

namespace ivo::firmware {

/// Both ends included.
struct Range {
  double least = 0.0;
  double most = 0.0;
  std::string_view unit = {};  ///< "metres"; empty for a plain number
};

struct TomlReading;  // what was read, asked for and found wrong

/// One value of the file, or none: every question to an absent value answers with the fallback.
/// Lives no longer than its TomlFile.
class TomlValue {
 public:
  [[nodiscard]] bool present() const noexcept { return node_ != nullptr; }
  [[nodiscard]] bool is_text() const noexcept { return is(TomlNode::Kind::kText); }
  [[nodiscard]] bool is_list() const noexcept { return is(TomlNode::Kind::kArray); }
  [[nodiscard]] bool is_table() const noexcept { return is(TomlNode::Kind::kTable); }

  /// Members of a table. A required one that is missing is a fault.
  [[nodiscard]] TomlValue required(std::string_view key) const;
  [[nodiscard]] TomlValue optional(std::string_view key) const;
  /// A fault, in the words of `what`, if the table has this member: it is known but has no place here.
  void refuse(std::string_view key, std::string_view what) const;

  [[nodiscard]] double number(const Range& range, double fallback = 0.0) const;
  [[nodiscard]] std::int64_t integer(std::int64_t least, std::int64_t most, std::int64_t fallback = 0) const;
  [[nodiscard]] bool flag(bool fallback = false) const;
  /// Not empty, no control characters.
  [[nodiscard]] std::string text(std::string_view fallback = {}) const;
  /// The index of the word in `words`.
  [[nodiscard]] std::size_t choice(std::initializer_list<std::string_view> words, std::size_t fallback = 0) const;
  /// [x, y], both in `range`.
  [[nodiscard]] Point point(const Range& range) const;
  /// Elements of a list of `least` to `most`; empty when there is trouble or no value. `what` names them in a
  /// complaint.
  [[nodiscard]] std::vector<TomlValue> items(std::size_t least, std::size_t most, std::string_view what) const;

  /// A fault of this value, in words of the caller: "what was wrong; what is expected".
  void complain(std::string_view what) const;

 private:
  friend class TomlFile;
  TomlValue(TomlReading& reading, const TomlNode* node, std::string path)
      : reading_(&reading), node_(node), path_(std::move(path)) {}
  [[nodiscard]] bool is(TomlNode::Kind kind) const noexcept { return node_ != nullptr && node_->kind == kind; }
  [[nodiscard]] const TomlNode* member(std::string_view key) const;
  [[nodiscard]] std::string path_to(std::string_view key) const;
  void complain_of_kind(std::string_view expected) const;

  TomlReading* reading_;
  const TomlNode* node_;
  std::string path_;
};

class TomlFile {
 public:
  /// Fails on what cannot be read and on what is not TOML.
  [[nodiscard]] static Result<TomlFile> read(const std::string& path);
  [[nodiscard]] static Result<TomlFile> parse(std::string_view text, const std::string& path);

  TomlFile(TomlFile&&) noexcept;
  TomlFile& operator=(TomlFile&&) noexcept;
  ~TomlFile();

  [[nodiscard]] TomlValue root() const;
  /// The first fault by line, if any; missing keys come last, because a misspelt one explains a missing one.
  [[nodiscard]] Result<void> finish() const;
  [[nodiscard]] const Lines& lines() const noexcept;

 private:
  explicit TomlFile(std::unique_ptr<TomlReading> reading);
  std::unique_ptr<TomlReading> reading_;
};

}  // namespace ivo::firmware
