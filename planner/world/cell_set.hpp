// A set of cells of a map, one bit each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/world/cells.hpp"

namespace ivo::planner {

class CellSet {
 public:
  /// True when it was not there before.
  bool insert(Cell c) noexcept {
    std::uint64_t& word = words_[index(c) / 64];
    const std::uint64_t bit = std::uint64_t{1} << (index(c) % 64);
    const bool is_new = (word & bit) == 0;
    word |= bit;
    return is_new;
  }
  [[nodiscard]] bool contains(Cell c) const noexcept { return (words_[index(c) / 64] >> (index(c) % 64) & 1U) != 0; }

  /// Cell c is bit c % 64 of word c / 64.
  [[nodiscard]] std::span<const std::uint64_t> words() const noexcept { return words_; }

 private:
  std::array<std::uint64_t, limits::kCells / 64> words_{};
};
static_assert(limits::kCells % 64 == 0);

}  // namespace ivo::planner
