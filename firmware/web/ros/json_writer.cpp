#include "firmware/web/ros/json_writer.hpp"

#include <charconv>
#include <cmath>

#include "firmware/files/number_text.hpp"

namespace ivo::firmware::web {
namespace {

/// Texts come from documents and messages that were UTF-8.
std::string quoted(std::string_view text) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      (out += '\\') += c;
    } else if (byte < 0x20) {
      ((out += "\\u00") += kDigits[byte >> 4U]) += kDigits[byte & 0xFU];
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace

void JsonWriter::open(char bracket) {
  raw(std::string_view(&bracket, 1));
  behind_value_ = false;
}

void JsonWriter::close(char bracket) {
  text_ += bracket;
  behind_value_ = true;
}

void JsonWriter::raw(std::string_view json) {
  if (behind_value_) {
    text_ += ',';
  }
  text_ += json;
  behind_value_ = true;
}

void JsonWriter::key(std::string_view name) {
  raw(quoted(name));
  text_ += ':';
  behind_value_ = false;
}

void JsonWriter::text(std::string_view value) { raw(quoted(value)); }
void JsonWriter::number(double value) { raw(std::isfinite(value) ? shortest(value) : "null"); }
void JsonWriter::whole(std::int64_t value) { raw(std::to_string(value)); }
void JsonWriter::flag(bool value) { raw(value ? "true" : "false"); }

void JsonWriter::bytes(std::span<const std::int8_t> values) {
  begin_list();
  for (const std::int8_t value : values) {
    char digits[8];
    raw({digits, std::to_chars(digits, digits + sizeof digits, static_cast<int>(value)).ptr});
  }
  end_list();
}

void JsonWriter::floats(std::span<const float> values) {
  begin_list();
  for (const float value : values) {
    char digits[24];
    raw(std::isfinite(value) ? std::string_view(digits, std::to_chars(digits, digits + sizeof digits, value).ptr)
                             : "null");
  }
  end_list();
}

}  // namespace ivo::firmware::web
