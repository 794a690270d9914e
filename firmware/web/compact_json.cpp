#include "firmware/web/compact_json.hpp"

#include <cmath>
#include <cstddef>

#include "firmware/files/number_text.hpp"

namespace ivo::firmware::web {
namespace {

/// Bytes of the character that begins at `at`; 0: none does.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(at);
  const unsigned second = byte(at + 1);
  if (first < 0x80U) return 1;
  if (first >= 0xC2U && first <= 0xDFU && follows(at + 1)) return 2;
  if (first >= 0xE0U && first <= 0xEFU && follows(at + 1) && follows(at + 2)) {
    const bool overlong = first == 0xE0U && second < 0xA0U;
    const bool surrogate = first == 0xEDU && second >= 0xA0U;
    return overlong || surrogate ? 0 : 3;
  }
  if (first >= 0xF0U && first <= 0xF4U && follows(at + 1) && follows(at + 2) && follows(at + 3)) {
    const bool outside = (first == 0xF0U && second < 0x90U) || (first == 0xF4U && second >= 0x90U);
    return outside ? 0 : 4;
  }
  return 0;
}

void append_quoted(std::string_view value, std::string& to) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  to += '"';
  for (std::size_t i = 0; i < value.size();) {
    const char c = value[i];
    const auto code = static_cast<unsigned char>(c);
    const std::size_t length = utf8_length(value, i);
    if (c == '"' || c == '\\') {
      (to += '\\') += c;
    } else if (code < ' ') {
      ((to += "\\u00") += kDigits[code >> 4U]) += kDigits[code & 15U];
    } else if (length == 0) {
      to += '?';
    } else {
      to += value.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  to += '"';
}

}  // namespace

void CompactJson::separate() {
  if (!first_) {
    written_ += ',';
  }
  first_ = false;
}

CompactJson& CompactJson::open(char bracket) {
  separate();
  written_ += bracket;
  first_ = true;
  return *this;
}

CompactJson& CompactJson::close(char bracket) {
  written_ += bracket;
  first_ = false;
  return *this;
}

CompactJson& CompactJson::key(std::string_view name) {
  separate();
  append_quoted(name, written_);
  written_ += ':';
  first_ = true;
  return *this;
}

CompactJson& CompactJson::text(std::string_view value) {
  separate();
  append_quoted(value, written_);
  return *this;
}

CompactJson& CompactJson::raw(std::string_view json) {
  separate();
  written_ += json;
  return *this;
}

CompactJson& CompactJson::flag(bool value) { return raw(value ? "true" : "false"); }
CompactJson& CompactJson::null() { return raw("null"); }
CompactJson& CompactJson::count(std::uint64_t value) { return raw(std::to_string(value)); }
CompactJson& CompactJson::number(double value) { return std::isfinite(value) ? raw(shortest(value)) : null(); }

}  // namespace ivo::firmware::web
