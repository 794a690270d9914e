// Which cells somebody has seen, one bit each, and what a look adds to them. A look comes as swaths: windows of 64
// columns, so that a row of one costs a load, a mask and a store.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "config/base/contract.hpp"
#include "config/limits.hpp"
#include "planner/world/cells.hpp"

namespace ivo::planner {

static_assert(std::endian::native == std::endian::little, "a window is read as one word over eight bytes of columns");

/// What is seen from some consecutive sight points of a move: a window of 64 columns, one word a row.
struct Swath {
  std::int32_t first_row = 0;
  std::int32_t first_byte = 0;  ///< its first column is 8 times this
  std::int32_t first_word = 0;  ///< of its rows, in the words of whoever made it
  std::int16_t rows = 0;
  std::int16_t first_point = 0;  ///< the cells of the window seen from these points, both included
  std::int16_t last_point = 0;
};

class SeenMap {
 public:
  static constexpr int kBytes = limits::kCells / 4 + 64;

  [[nodiscard]] static constexpr int stride_of(int columns) noexcept { return (columns - 1) / 8 + 8; }
  /// Narrow maps need more than a bit a cell: a window may hang over the last column.
  [[nodiscard]] static constexpr bool fits(int columns, int rows) noexcept {
    return static_cast<std::int64_t>(stride_of(columns)) * rows <= kBytes;
  }

  /// Nothing seen, on a grid of these columns and rows. Cost: the bytes.
  void open(int columns, int rows) noexcept {
    columns_ = columns;
    stride_ = stride_of(columns);
    used_ = stride_ * rows;
    std::memset(bytes_.data(), 0, static_cast<std::size_t>(used_));
  }
  /// As `other`. Cost: the bytes.
  void copy(const SeenMap& other) noexcept { copy(other, 0, other.used_); }
  /// The same by parts: bytes `first` to `first + count - 1`; of use when all have been copied.
  void copy(const SeenMap& other, int first, int count) noexcept {
    columns_ = other.columns_;
    stride_ = other.stride_;
    used_ = other.used_;
    std::memcpy(bytes_.data() + first, other.bytes_.data() + first, static_cast<std::size_t>(count));
  }

  [[nodiscard]] int stride() const noexcept { return stride_; }
  [[nodiscard]] int bytes() const noexcept { return used_; }
  [[nodiscard]] Cell cell(int row, int first_byte, int bit) const noexcept {
    return row * columns_ + 8 * first_byte + bit;
  }

  void set(int column, int row) noexcept { byte(column, row) |= bit(column); }
  [[nodiscard]] bool test(int column, int row) const noexcept {
    return (bytes_[index(row * stride_ + column / 8)] & bit(column)) != 0;
  }
  /// Sets columns `first` to `last`, both included.
  void set_run(int row, int first, int last) noexcept {
    for (int column = first; column <= last;) {
      const int end = std::min(last, column | 7);
      const unsigned run = ((2U << static_cast<unsigned>(end - column)) - 1U) << static_cast<unsigned>(column & 7);
      byte(column, row) |= static_cast<std::uint8_t>(run);
      column = end + 1;
    }
  }

  [[nodiscard]] std::uint64_t window(int row, int first_byte) const noexcept {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes_.data() + row * stride_ + first_byte, sizeof word);
    return word;
  }
  void set_window(int row, int first_byte, std::uint64_t word) noexcept {
    std::memcpy(bytes_.data() + row * stride_ + first_byte, &word, sizeof word);
  }

  /// Marks what the swath shows; `on_new(row, word)` gets the cells of a row that nobody had seen. Cost: the rows.
  template <class OnNew>
  void look(const Swath& swath, const std::uint64_t* words, OnNew&& on_new) noexcept {
    std::uint8_t* at = bytes_.data() + swath.first_row * stride_ + swath.first_byte;
    for (int i = 0; i < swath.rows; ++i, at += stride_) {
      std::uint64_t seen = 0;
      std::memcpy(&seen, at, sizeof seen);
      const std::uint64_t fresh = words[i] & ~seen;
      if (fresh != 0) {
        seen |= fresh;
        std::memcpy(at, &seen, sizeof seen);
        on_new(swath.first_row + i, fresh);
      }
    }
  }

  /// As look(), for who only wants to know how many.
  int look_and_count(const Swath& swath, const std::uint64_t* words) noexcept {
    std::uint8_t* at = bytes_.data() + swath.first_row * stride_ + swath.first_byte;
    int count = 0;
    for (int i = 0; i < swath.rows; ++i, at += stride_) {
      std::uint64_t seen = 0;
      std::memcpy(&seen, at, sizeof seen);
      count += std::popcount(words[i] & ~seen);
      seen |= words[i];
      std::memcpy(at, &seen, sizeof seen);
    }
    return count;
  }

  /// True when the swath shows a cell that nobody has seen.
  [[nodiscard]] bool any_new(const Swath& swath, const std::uint64_t* words) const noexcept {
    for (int i = 0; i < swath.rows; ++i) {
      if ((words[i] & ~window(swath.first_row + i, swath.first_byte)) != 0) {
        return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] static constexpr std::uint8_t bit(int column) noexcept {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(column & 7));
  }
  [[nodiscard]] std::uint8_t& byte(int column, int row) noexcept { return bytes_[index(row * stride_ + column / 8)]; }

  int columns_ = 0;
  int stride_ = 0;
  int used_ = 0;
  std::array<std::uint8_t, kBytes> bytes_{};
};

/// Calls `on_bit(bit)` for each bit set, lowest first.
template <class OnBit>
void for_each_bit(std::uint64_t word, OnBit&& on_bit) noexcept {
  for (; word != 0; word &= word - 1) {
    on_bit(std::countr_zero(word));
  }
}

}  // namespace ivo::planner
