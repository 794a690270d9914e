// The open cells of a shortest-path search whose moves cost between one and less than two `kWidth`: by value in buckets
// of that width, each a list through two arrays of the caller (Dial, Algorithm 360, CACM 1969).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "planner/numeric/index.hpp"

namespace ivo::planner {

/// Cost of each call: constant. Within a bucket any order is right, as no move is shorter than it is wide.
template <std::int32_t kWidth>
class OpenBuckets {
 public:
  /// `next` and `previous` have a place for each cell.
  OpenBuckets(std::span<std::int32_t> next, std::span<std::int32_t> previous) noexcept
      : next_(next), previous_(previous) {
    heads_.fill(kNone);
  }

  void add(std::int32_t cell, std::int32_t value) noexcept {
    std::int32_t& head = heads_[bucket(value)];
    next_[index(cell)] = head;
    previous_[index(cell)] = kNone;
    if (head != kNone) {
      previous_[index(head)] = cell;
    }
    head = cell;
    ++count_;
  }

  /// A cell that was added with this value and not taken since.
  void remove(std::int32_t cell, std::int32_t value) noexcept {
    const std::int32_t before = previous_[index(cell)];
    const std::int32_t after = next_[index(cell)];
    (before == kNone ? heads_[bucket(value)] : next_[index(before)]) = after;
    if (after != kNone) {
      previous_[index(after)] = before;
    }
    --count_;
  }

  /// A cell of the least bucket that holds any, -1 when none does.
  [[nodiscard]] std::int32_t take() noexcept {
    if (count_ == 0) {
      return kNone;
    }
    while (heads_[present_] == kNone) {
      present_ = (present_ + 1) % heads_.size();
    }
    const std::int32_t cell = heads_[present_];
    heads_[present_] = next_[index(cell)];
    if (heads_[present_] != kNone) {
      previous_[index(heads_[present_])] = kNone;
    }
    --count_;
    return cell;
  }

 private:
  static constexpr std::int32_t kNone = -1;
  static constexpr std::int32_t kBuckets = 3;

  [[nodiscard]] static std::size_t bucket(std::int32_t value) noexcept { return index(value / kWidth % kBuckets); }

  std::span<std::int32_t> next_;
  std::span<std::int32_t> previous_;
  std::array<std::int32_t, kBuckets> heads_{};
  std::size_t present_ = 0;
  int count_ = 0;
};

}  // namespace ivo::planner
