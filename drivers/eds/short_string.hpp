// A few characters kept by value: of a longer text, its beginning.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ivo::drivers {

template <std::size_t Capacity>
class ShortString {
  static_assert(Capacity < 256);

 public:
  constexpr ShortString() noexcept = default;
  explicit constexpr ShortString(std::string_view text) noexcept
      : size_(static_cast<std::uint8_t>(std::min(text.size(), Capacity))) {
    std::copy_n(text.begin(), size_, characters_.begin());
  }
  [[nodiscard]] constexpr std::string_view view() const noexcept { return {characters_.data(), size_}; }

 private:
  std::array<char, Capacity> characters_{};
  std::uint8_t size_ = 0;
};

}  // namespace ivo::drivers
