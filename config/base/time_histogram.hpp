// How often something took how long: fixed size, no heap, one increment a value. Good to one part in sixteen.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "config/base/time.hpp"

namespace ivo {

/// Counts of 0 ns to 4.3 s in buckets one sixteenth of an octave wide; what is longer goes to the last one. 2 kB.
class TimeHistogram {
 public:
  /// Below 0 counts as 0.
  void add(Duration time) noexcept {
    const auto ns = static_cast<std::uint64_t>(std::max<Duration::rep>(time.count(), 0));
    ++counts_[bucket_of(std::min<std::uint64_t>(ns, kLargest))];
    ++count_;
    total_ += Duration(static_cast<Duration::rep>(ns));
    worst_ = std::max(worst_, Duration(static_cast<Duration::rep>(ns)));
  }

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] Duration total() const noexcept { return total_; }
  [[nodiscard]] Duration worst() const noexcept { return worst_; }  ///< exact; 0 without a value

  /// The least time that at least `share` (0 to 1) of all values did not exceed, rounded up to its bucket's end and
  /// never beyond worst(); 0 without a value. Cost: the buckets.
  [[nodiscard]] Duration quantile(double share) const noexcept {
    const double wanted = share * static_cast<double>(count_);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      sum += counts_[i];
      if (sum > 0 && static_cast<double>(sum) >= wanted) {
        return std::min(worst_, end_of(i));
      }
    }
    return worst_;
  }

  /// Values from `from` up to and not including `to`, as far as buckets tell: one counts where its bucket begins.
  [[nodiscard]] std::uint64_t between(Duration from, Duration to) const noexcept {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      const Duration begin = begin_of(i);
      sum += begin >= from && begin < to ? counts_[i] : 0;
    }
    return sum;
  }

 private:
  static constexpr std::uint64_t kLargest = 0xFFFF'FFFF;
  static constexpr unsigned kParts = 16;  // of an octave
  static constexpr unsigned kPartBits = 4;
  static constexpr std::size_t kBuckets = (32 - kPartBits + 1) * kParts;

  static constexpr std::size_t bucket_of(std::uint64_t ns) noexcept {
    const auto bits = static_cast<unsigned>(std::bit_width(ns));
    const unsigned octave = bits > kPartBits ? bits - kPartBits - 1 : 0;
    return octave * kParts + (ns >> octave);
  }
  static constexpr Duration begin_of(std::size_t bucket) noexcept {
    const std::size_t octave = bucket < 2 * kParts ? 0 : bucket / kParts - 1;
    return Duration(static_cast<Duration::rep>((bucket - octave * kParts) << octave));
  }
  static constexpr Duration end_of(std::size_t bucket) noexcept { return begin_of(bucket + 1) - Duration(1); }

  std::array<std::uint32_t, kBuckets> counts_{};
  std::uint64_t count_ = 0;
  Duration total_{};
  Duration worst_{};
};

}  // namespace ivo
