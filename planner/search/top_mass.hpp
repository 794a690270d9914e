// The largest masses among the cells that are in, while cells come in one by one: a binary indexed tree (Fenwick 1994)
// over blocks of 64 ranks.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/numeric/scalar.hpp"

namespace ivo::planner {

class TopMass {
 public:
  /// None is in. `by_rank` are the masses, largest first; it stays the caller's. Cost: the masses over 64.
  void start(std::span<const std::int32_t> by_rank, std::span<const Mass> mass) noexcept {
    by_rank_ = by_rank;
    mass_ = mass;
    blocks_ = (by_rank.size() + kBlock - 1) / kBlock;
    std::fill_n(in_.begin(), blocks_, 0);
    std::fill_n(nodes_.begin(), blocks_ + 1, Node{});
    all_ = {};
  }

  /// Cost: the logarithm of the blocks.
  void add(std::int32_t rank) noexcept {
    const double m = mass_of(index(rank));
    in_[index(rank) / kBlock] |= std::uint64_t{1} << (index(rank) % kBlock);
    for (std::size_t i = index(rank) / kBlock + 1; i <= blocks_; i += i & (~i + 1)) {
      ++nodes_[i].count;
      nodes_[i].mass += m;
    }
    ++all_.count;
    all_.mass += m;
  }

  /// The mass of the `count` largest that are in, a broken one counted by its part. Cost: the logarithm of the blocks,
  /// and a block.
  [[nodiscard]] double largest(double count) const noexcept {
    if (count >= all_.count) {
      return all_.mass;
    }
    std::size_t at = 0;
    double sum = 0.0;
    for (std::size_t step = std::bit_floor(blocks_); step > 0; step /= 2) {
      if (at + step <= blocks_ && nodes_[at + step].count <= count) {
        at += step;
        count -= nodes_[at].count;
        sum += nodes_[at].mass;
      }
    }
    for (std::uint64_t left = at < blocks_ ? in_[at] : 0; left != 0 && count > 0.0; left &= left - 1) {
      const double m = mass_of(at * kBlock + static_cast<std::size_t>(std::countr_zero(left)));
      sum += std::min(count, 1.0) * m;
      count -= 1.0;
    }
    return sum;
  }

 private:
  static constexpr std::size_t kBlock = 64;
  static constexpr std::size_t kBlocks = (limits::kCells + kBlock - 1) / kBlock;
  struct Node {
    double mass = 0.0;
    std::int32_t count = 0;
  };

  [[nodiscard]] double mass_of(std::size_t rank) const noexcept { return to_double(mass_[index(by_rank_[rank])]); }

  std::span<const std::int32_t> by_rank_;
  std::span<const Mass> mass_;
  std::size_t blocks_ = 0;
  Node all_;
  std::array<std::uint64_t, kBlocks> in_{};
  std::array<Node, kBlocks + 1> nodes_{};
};

}  // namespace ivo::planner
