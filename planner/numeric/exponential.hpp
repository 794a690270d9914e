// exp(x) for x <= 0 from additions and multiplications alone, so that a prior and a trail limit have the same last bit
// on every CPU; libm picks variants by CPU. Relative error below 4e-16 * (1 + |x|).
#pragma once

#include <array>
#include <cstdint>

#include "config/base/contract.hpp"

namespace ivo::planner {

[[nodiscard]] constexpr double exp_negative(double x) noexcept {
  IVO_CONTRACT(x <= 0.0);
  constexpr double kUnderflow = -700.0;
  if (x < kUnderflow) {
    return 0.0;
  }
  // x = r - halvings * ln 2 with |r| <= ln 2 / 2; ln 2 is split so that the product is exact.
  constexpr double kLn2High = 0x1.62e42fee00000p-1;
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  const auto halvings = static_cast<std::int64_t>(-x / (kLn2High + kLn2Low) + 0.5);
  const auto n = static_cast<double>(halvings);
  const double r = (x + n * kLn2High) + n * kLn2Low;

  double sum = 1.0;
  for (int term = 14; term >= 1; --term) {
    sum = 1.0 + sum * r / term;
  }
  constexpr std::array<double, 4> kPowers = {0x1p-1, 0x1p-2, 0x1p-4, 0x1p-8};
  std::int64_t left = halvings;
  for (; left >= 16; left -= 16) {
    sum *= 0x1p-16;
  }
  for (unsigned bit = 0; bit < kPowers.size(); ++bit) {
    if (((static_cast<std::uint64_t>(left) >> bit) & 1U) != 0) {
      sum *= kPowers[bit];
    }
  }
  return sum;
}

}  // namespace ivo::planner
