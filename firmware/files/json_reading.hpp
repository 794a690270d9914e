// Typed, checked reading of a JSON document: fields one by one; after the first fault the answers are defaults and the
// fault is kept, as "PATH: FIELD: what was wrong; what is expected".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "firmware/files/json_value.hpp"

namespace ivo::firmware {

class JsonReading {
 public:
  explicit JsonReading(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] bool ok() const { return fault_.empty(); }
  [[nodiscard]] Error error() const { return Error{fault_}; }
  void fault(const std::string& field, const std::string& what);

  // `at` is the path of `object`, with its dot: "agents[1].".
  [[nodiscard]] const Json* field(const Json& object, const std::string& at, const char* key);
  [[nodiscard]] std::string text(const Json& object, const std::string& at, const char* key);
  [[nodiscard]] bool flag(const Json& object, const std::string& at, const char* key);
  [[nodiscard]] double number(const Json* value, const std::string& name, double least, double most);
  [[nodiscard]] double number(const Json& object, const std::string& at, const char* key, double least, double most) {
    return number(field(object, at, key), at + key, least, most);
  }
  [[nodiscard]] std::uint64_t count(const Json& object, const std::string& at, const char* key, std::uint64_t most);
  /// The index of the word in `words`, of which there are at least two.
  [[nodiscard]] std::size_t choice(const Json& object, const std::string& at, const char* key,
                                   std::span<const char* const> words);
  /// Empty when it is no list of at least one.
  [[nodiscard]] const Json& list(const Json& object, const std::string& at, const char* key);
  /// [x, y], both within 1e6 m.
  [[nodiscard]] Point point(const Json& value, const std::string& name);

 private:
  std::string path_;
  std::string fault_;
};

/// Somebody's text in a complaint: in quotation marks, at most 200 bytes of it.
[[nodiscard]] std::string shown_text(const std::string& text);

/// "agents[1]"
[[nodiscard]] inline std::string element(const std::string& list, std::size_t i) {
  return list + "[" + std::to_string(i) + "]";
}

}  // namespace ivo::firmware
