#include "drivers/eds/eds_number.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <optional>

namespace ivo::drivers {
namespace {

constexpr std::string_view kNodeId = "$NODEID";
constexpr std::uint64_t kHighestNodeId = 127;

char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Takes $NODEID and its + from either end of `text`.
bool take_node_id(std::string_view& text) noexcept {
  if (starts_with_word(text, kNodeId)) {
    text = trimmed(text.substr(kNodeId.size()));
    if (text.empty()) {
      text = "0";
    } else if (text.front() == '+') {
      text = trimmed(text.substr(1));
    } else {
      text = {};
    }
    return true;
  }
  if (text.size() > kNodeId.size() && same_word(text.substr(text.size() - kNodeId.size()), kNodeId)) {
    text = trimmed(text.substr(0, text.size() - kNodeId.size()));
    text = text.empty() || text.back() != '+' ? std::string_view() : trimmed(text.substr(0, text.size() - 1));
    return true;
  }
  return false;
}

struct Digits {
  EdsNumberStatus status = EdsNumberStatus::kNotANumber;
  std::uint64_t magnitude = 0;
  bool bits = false;  // hexadecimal or octal
};

Digits digits(std::string_view text) noexcept {
  int base = 10;
  if (starts_with_word(text, "0x")) {
    base = 16;
    text.remove_prefix(2);
  } else if (text.size() > 1 && text.front() == '0') {
    base = 8;
    text.remove_prefix(1);
  }
  Digits result{.bits = base != 10};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.magnitude, base);
  if (text.empty() || error == std::errc::invalid_argument || end != text.data() + text.size()) {
    return result;
  }
  result.status = error == std::errc() ? EdsNumberStatus::kNumber : EdsNumberStatus::kOutOfRange;
  return result;
}

EdsNumber real(std::string_view text, DataType type) noexcept {
  EdsNumber number;
  const auto take = [&](auto& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end == text.data() + text.size() && error != std::errc::invalid_argument) {
      number.status = error == std::errc() ? EdsNumberStatus::kNumber : EdsNumberStatus::kOutOfRange;
    }
  };
  if (type == DataType::kReal32) {
    float value = 0.0F;
    take(value);
    number.value = {true, false, std::bit_cast<std::uint32_t>(value)};
  } else {
    double value = 0.0;
    take(value);
    number.value = {true, false, std::bit_cast<std::uint64_t>(value)};
  }
  return number;
}

std::optional<std::uint64_t> fitted(const Digits& digits, bool negative, DataType type) noexcept {
  if (negative) {
    const auto least = std::uint64_t{0} - static_cast<std::uint64_t>(least_of(type));
    return digits.magnitude <= least ? std::optional(std::uint64_t{0} - digits.magnitude) : std::nullopt;
  }
  if (digits.magnitude <= most_of(type)) {
    return digits.magnitude;
  }
  const int unused = 64 - 8 * bytes_of(type);
  if (!digits.bits || !is_signed(type) || digits.magnitude << unused >> unused != digits.magnitude) {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(digits.magnitude << unused) >> unused);
}

}  // namespace

std::string_view trimmed(std::string_view text) noexcept {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

bool same_word(std::string_view a, std::string_view b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

bool starts_with_word(std::string_view text, std::string_view word) noexcept {
  return text.size() >= word.size() && same_word(text.substr(0, word.size()), word);
}

EdsNumber eds_number(std::string_view text, DataType type) noexcept {
  text = trimmed(text);
  if (is_real(type) && !starts_with_word(text, "0x")) {
    return real(text, type);
  }
  const bool plus_node = take_node_id(text);
  const bool negative = !text.empty() && text.front() == '-';
  const Digits magnitude = digits(negative ? text.substr(1) : text);
  if (magnitude.status != EdsNumberStatus::kNumber || (negative && magnitude.bits) ||
      (plus_node && !is_unsigned(type))) {
    return {magnitude.status == EdsNumberStatus::kOutOfRange ? magnitude.status : EdsNumberStatus::kNotANumber, {}};
  }
  // The bits of a REAL may be written in hexadecimal.
  const DataType range = type == DataType::kReal32   ? DataType::kUnsigned32
                         : type == DataType::kReal64 ? DataType::kUnsigned64
                                                     : type;
  const std::optional<std::uint64_t> bits = fitted(magnitude, negative, range);
  if (!bits.has_value() || (plus_node && most_of(range) - *bits < kHighestNodeId)) {
    return {EdsNumberStatus::kOutOfRange, {}};
  }
  return {EdsNumberStatus::kNumber, {true, plus_node, *bits}};
}

}  // namespace ivo::drivers
