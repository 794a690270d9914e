// A JSON document as a tree of plain values. Reading one with checks: json_reading.hpp.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"

namespace ivo::firmware {

struct Json;
/// In the order in which they are written; of two of one name the last was read.
using JsonMember = std::pair<std::string, Json>;

struct Json {
  enum class Kind : std::uint8_t { kNull, kFlag, kCount, kReal, kText, kList, kObject };

  Json() = default;
  Json(bool value) : kind(Kind::kFlag), flag(value) {}          // NOLINT(google-explicit-constructor): {"key", value}
  Json(double value) : kind(Kind::kReal), real(value) {}        // NOLINT(google-explicit-constructor): as above
  Json(int value) : Json(static_cast<std::uint64_t>(value)) {}  // NOLINT(google-explicit-constructor): as above
  Json(std::uint64_t value);                                    // NOLINT(google-explicit-constructor): as above
  Json(std::string value);                                      // NOLINT(google-explicit-constructor): as above
  Json(const char* value) : Json(std::string(value)) {}         // NOLINT(google-explicit-constructor): as above
  Json(Point p);                                                // NOLINT(google-explicit-constructor): [x, y]
  Json(std::initializer_list<JsonMember> value);
  [[nodiscard]] static Json list() { return of(Kind::kList); }
  [[nodiscard]] static Json of(Kind kind) {
    Json json;
    json.kind = kind;
    return json;
  }

  /// Of an object, null without it.
  [[nodiscard]] const Json* member(std::string_view name) const;
  [[nodiscard]] bool is_number() const noexcept { return kind == Kind::kCount || kind == Kind::kReal; }

  Kind kind = Kind::kNull;
  bool flag = false;
  std::uint64_t count = 0;          ///< kCount: a whole number, not negative
  double real = 0.0;                ///< kReal, and kCount as a number
  std::string text;                 ///< kText
  std::vector<Json> elements;       ///< kList
  std::vector<JsonMember> members;  ///< kObject
};

/// Null where there is none.
template <class Optional>
[[nodiscard]] Json json_or_null(const Optional& value) {
  return value ? Json(*value) : Json();
}

/// Same value, same bytes: numbers that read back as the same, and must be finite; text that is not UTF-8 is shown as
/// such. An object is written a member a line, and of a list of objects an element a line, so that a person can see
/// what changed between two files; a list of objects an element a line. Ends with a line break.
[[nodiscard]] std::string json_text(const Json& document);

/// Refuses what is no JSON, numbers that are too large, more than 64 levels and objects of more than 500 members, in
/// one line: "PATH: what was wrong; what is expected". `what` is what the file should be, for the complaint: "a plan".
[[nodiscard]] Result<Json> parse_json(std::string_view text, const std::string& path, const std::string& what);
/// Refuses two members of one name too.
[[nodiscard]] Result<Json> parse_strict_json(std::string_view text, const std::string& path, const std::string& what);

}  // namespace ivo::firmware
