// Fixed-point numbers with `F` bits behind the point in 64 bits: the same results on a processor of any kind, with or
// without a floating-point unit. Range: -2^(63-F) to 2^(63-F), exclusive; resolution 2^-F. Sums and differences are
// exact; a product keeps all its bits as Fixed<F + G>, which must fit; round_to() rounds towards minus infinity, /
// towards zero.
#pragma once

#include <compare>
#include <cstdint>

#include "config/base/contract.hpp"

namespace ivo::planner {

template <int F>
class Fixed {
  static_assert(F > 0 && F < 63);

 public:
  static constexpr int kFraction = F;

  constexpr Fixed() noexcept = default;
  explicit constexpr Fixed(int whole) noexcept : raw_(static_cast<std::int64_t>(whole) << F) {}
  /// To the nearest multiple of 2^-F; for tables and constants, not for the search.
  explicit constexpr Fixed(double value) noexcept
      : raw_(static_cast<std::int64_t>(value * static_cast<double>(std::int64_t{1} << F) + (value < 0 ? -0.5 : 0.5))) {}

  [[nodiscard]] static constexpr Fixed from_raw(std::int64_t raw) noexcept {
    Fixed f;
    f.raw_ = raw;
    return f;
  }
  [[nodiscard]] constexpr std::int64_t raw() const noexcept { return raw_; }
  [[nodiscard]] explicit constexpr operator double() const noexcept {
    return static_cast<double>(raw_) / static_cast<double>(std::int64_t{1} << F);
  }
  /// Towards minus infinity.
  [[nodiscard]] constexpr std::int32_t floor() const noexcept { return static_cast<std::int32_t>(raw_ >> F); }

  friend constexpr Fixed operator+(Fixed a, Fixed b) noexcept { return from_raw(a.raw_ + b.raw_); }
  friend constexpr Fixed operator-(Fixed a, Fixed b) noexcept { return from_raw(a.raw_ - b.raw_); }
  friend constexpr Fixed operator-(Fixed a) noexcept { return from_raw(-a.raw_); }
  friend constexpr Fixed operator*(Fixed a, int b) noexcept { return from_raw(a.raw_ * b); }
  friend constexpr Fixed operator*(int a, Fixed b) noexcept { return b * a; }
  friend constexpr Fixed operator/(Fixed a, int b) noexcept { return from_raw(a.raw_ / b); }
  constexpr Fixed& operator+=(Fixed b) noexcept { return *this = *this + b; }
  constexpr Fixed& operator-=(Fixed b) noexcept { return *this = *this - b; }
  friend constexpr auto operator<=>(Fixed a, Fixed b) noexcept = default;

 private:
  std::int64_t raw_ = 0;
};

template <int F, int G>
[[nodiscard]] constexpr Fixed<F + G> operator*(Fixed<F> a, Fixed<G> b) noexcept {
  return Fixed<F + G>::from_raw(a.raw() * b.raw());
}

/// The same value with fewer bits.
template <class To, int F>
[[nodiscard]] constexpr To round_to(Fixed<F> value) noexcept {
  static_assert(To::kFraction <= F);
  return To::from_raw(value.raw() >> (F - To::kFraction));
}

/// The largest whole number whose square is at most `n`. Cost: 32 steps.
[[nodiscard]] constexpr std::uint32_t whole_square_root(std::uint64_t n) noexcept {
  std::uint64_t root = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 62U; bit != 0; bit >>= 2U) {
    if (n >= root + bit) {
      n -= root + bit;
      root = (root >> 1U) + bit;
    } else {
      root >>= 1U;
    }
  }
  return static_cast<std::uint32_t>(root);
}

}  // namespace ivo::planner
