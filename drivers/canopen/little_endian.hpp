// Numbers as CANopen lays them on the bus: least significant byte first (CiA 301, 7.1.4).
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "config/base/contract.hpp"

namespace ivo::drivers {

/// The first sizeof(T) of `bytes`; the caller has checked that they are there.
template <std::unsigned_integral T>
[[nodiscard]] constexpr T load(std::span<const std::uint8_t> bytes) noexcept {
  IVO_CONTRACT(bytes.size() >= sizeof(T));
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value = static_cast<T>(value | static_cast<T>(T{bytes[i]} << (8 * i)));
  }
  return value;
}

/// Fills the first sizeof(T) of `bytes`.
template <std::unsigned_integral T>
constexpr void store(std::span<std::uint8_t> bytes, T value) noexcept {
  IVO_CONTRACT(bytes.size() >= sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

}  // namespace ivo::drivers
