// A vector whose room is part of the object. Full is an answer (push_back returns false), never an allocation.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include "config/base/contract.hpp"

namespace ivo {

template <class T, std::size_t Capacity>
class StaticVector {
  static_assert(std::is_trivially_copyable_v<T>, "StaticVector holds plain values");

 public:
  [[nodiscard]] static constexpr std::size_t capacity() noexcept { return Capacity; }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] constexpr bool full() const noexcept { return size_ == Capacity; }

  /// False, and nothing changed, when full.
  [[nodiscard]] constexpr bool push_back(const T& value) noexcept {
    if (full()) {
      return false;
    }
    items_[size_++] = value;
    return true;
  }
  constexpr void pop_back() noexcept {
    IVO_CONTRACT(size_ > 0);
    --size_;
  }
  constexpr void clear() noexcept { size_ = 0; }
  constexpr void resize(std::size_t size) noexcept {
    IVO_CONTRACT(size <= Capacity);
    size_ = size;
  }

  /// As `other`; unlike a copy it costs what is in it, not what there is room for.
  constexpr void assign(const StaticVector& other) noexcept {
    size_ = other.size_;
    for (std::size_t i = 0; i < size_; ++i) {
      items_[i] = other.items_[i];
    }
  }

  [[nodiscard]] constexpr T& operator[](std::size_t i) noexcept {
    IVO_CONTRACT(i < size_);
    return items_[i];
  }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const noexcept {
    IVO_CONTRACT(i < size_);
    return items_[i];
  }
  [[nodiscard]] constexpr T& back() noexcept { return (*this)[size_ - 1]; }
  [[nodiscard]] constexpr const T& back() const noexcept { return (*this)[size_ - 1]; }

  [[nodiscard]] constexpr T* begin() noexcept { return items_.data(); }
  [[nodiscard]] constexpr T* end() noexcept { return items_.data() + size_; }
  [[nodiscard]] constexpr const T* begin() const noexcept { return items_.data(); }
  [[nodiscard]] constexpr const T* end() const noexcept { return items_.data() + size_; }
  [[nodiscard]] constexpr std::span<const T> span() const noexcept { return {items_.data(), size_}; }

 private:
  std::array<T, Capacity> items_{};
  std::size_t size_ = 0;
};

}  // namespace ivo
