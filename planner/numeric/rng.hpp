// The planner's random numbers: SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, OOPSLA
// 2014). Given, seeded, and the same on every CPU.
#pragma once

#include <cstdint>

namespace ivo::planner {

class Rng {
 public:
  explicit constexpr Rng(std::uint64_t seed = 0) noexcept : state_(seed) {}

  [[nodiscard]] constexpr std::uint64_t next() noexcept {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }

  /// Uniform in [0, 1), a multiple of 2^-53.
  [[nodiscard]] constexpr double unit() noexcept { return static_cast<double>(next() >> 11U) * 0x1p-53; }

  /// Uniform in [0, count), count at least 1; the bias of 2^-53 is below anything that could be measured.
  [[nodiscard]] constexpr int below(int count) noexcept { return static_cast<int>(unit() * count); }

 private:
  std::uint64_t state_;
};

}  // namespace ivo::planner
