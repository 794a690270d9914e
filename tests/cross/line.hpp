// One line of output, made without a heap: words, whole numbers, hexadecimal and fractions from whole numbers alone.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "tests/cross/machine.hpp"

namespace ivo::cross {

class Line {
 public:
  Line() = default;
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  ~Line() {
    text("\n");
    print({text_.data(), size_});
  }

  Line& text(std::string_view word) noexcept {
    for (const char c : word) {
      if (size_ < text_.size()) {
        text_[size_++] = c;
      }
    }
    return *this;
  }
  Line& whole(std::int64_t number, int least_digits = 1) noexcept {
    std::array<char, 24> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
    for (auto missing = least_digits - (end - digits.begin()); missing > 0; --missing) {
      text("0");
    }
    return text({digits.begin(), static_cast<std::size_t>(end - digits.begin())});
  }
  /// Sixteen digits.
  Line& hex(std::uint64_t number) noexcept {
    for (int shift = 60; shift >= 0; shift -= 4) {
      text(std::string_view("0123456789abcdef").substr((number >> static_cast<unsigned>(shift)) & 15U, 1));
    }
    return *this;
  }
  /// Of a number that is not negative, cut to three digits after the point.
  Line& decimal(std::int64_t thousandths) noexcept {
    return whole(thousandths / 1000).text(".").whole(thousandths % 1000, 3);
  }

 private:
  std::array<char, 200> text_{};
  std::size_t size_ = 0;
};

}  // namespace ivo::cross
