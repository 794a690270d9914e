// What a fuzz target is given, taken byte by byte, and what it must not find.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>

#include "hal/api/can_frame.hpp"

namespace ivo::fuzz {

/// Ends the run as a crash does; `what` names the invariant that broke.
inline void require(bool holds, const char* what) {
  if (!holds) {
    (void)std::fprintf(stderr, "fuzz: broken: %s\n", what);
    __builtin_trap();
  }
}

/// Zeros once nothing is left.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

  [[nodiscard]] bool empty() const { return left_.empty(); }

  /// Any value of T.
  template <class T>
  T take() {
    T value{};
    const std::size_t bytes = std::min(sizeof(T), left_.size());
    std::memcpy(&value, left_.data(), bytes);
    left_ = left_.subspan(bytes);
    return value;
  }

  std::uint8_t byte() { return take<std::uint8_t>(); }

  /// 0 to `most`.
  unsigned up_to(unsigned most) { return byte() % (most + 1); }

  /// A frame with `id` and whatever length and data.
  hal::CanFrame frame(std::uint16_t id) {
    hal::CanFrame frame{.id = id, .size = static_cast<std::uint8_t>(up_to(8)), .data = {}};
    for (std::size_t i = 0; i < frame.size; ++i) {
      frame.data[i] = byte();
    }
    return frame;
  }

  std::span<const std::uint8_t> rest() {
    const std::span<const std::uint8_t> rest = left_;
    left_ = {};
    return rest;
  }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace ivo::fuzz
