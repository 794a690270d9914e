// JSON by hand, for records of many small messages: what is appended is whole and in order.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "config/base/time.hpp"

namespace ivo::firmware {

/// An object that is written member by member.
class JsonText {
 public:
  JsonText() { text_ += '{'; }

  JsonText& add(std::string_view key, double value) {
    char number[32];
    (void)std::snprintf(number, sizeof number, "%.9g", std::isfinite(value) ? value : 0.0);
    return raw(key, number);
  }
  JsonText& add(std::string_view key, std::int64_t value) { return raw(key, std::to_string(value)); }
  JsonText& add(std::string_view key, std::string_view text) { return raw(key, quoted(text)); }
  JsonText& add(std::string_view key, Duration time) {
    const Duration::rep ns = time.count();
    return raw(key, JsonText().add("sec", ns / 1'000'000'000).add("nsec", ns % 1'000'000'000).done());
  }
  /// `json`: a value as it is.
  JsonText& raw(std::string_view key, std::string_view json) {
    if (text_.size() > 1) {
      text_ += ',';
    }
    text_ += quoted(key);
    text_ += ':';
    text_ += json;
    return *this;
  }
  [[nodiscard]] std::string done() {
    text_ += '}';
    return std::move(text_);
  }

  [[nodiscard]] static std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') {
        out += '\\';
      }
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out + '"';
  }

 private:
  std::string text_;
};

}  // namespace ivo::firmware
