// Masses as bits: mass is the weighted sum of a few planes, so that a sum over 64 cells is a few counts. Where all
// cells have the same mass one plane is exact; elsewhere five keep 1/31 of the largest, and what is below is dithered,
// so that sums over many cells stay right.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "planner/search/belief.hpp"

namespace ivo::planner {

class MassPlanes {
 public:
  /// From one mass a cell. Cost: the cells with mass.
  void build(const Cells& cells, const Belief& belief, const std::array<Mass, limits::kCells>& mass) noexcept;

  /// Mass of the cells of a window. Cost: the planes.
  [[nodiscard]] Mass of(int row, int first_byte, std::uint64_t word) const noexcept {
    Mass sum{};
    for (int b = 0; b < count_; ++b) {
      sum += weights_[index(b)] * std::popcount(word & planes_[index(b)].window(row, first_byte));
    }
    return sum;
  }

  [[nodiscard]] int count() const noexcept { return count_; }

 private:
  static constexpr int kPlanes = 5;
  int count_ = 1;
  std::array<Mass, kPlanes> weights_{};
  std::array<SeenMap, kPlanes> planes_{};
};

}  // namespace ivo::planner
