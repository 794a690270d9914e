// The newest value from one writer thread to one reader thread: a triple buffer, no lock, no wait, nothing torn.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace ivo {

template <class T>
class Latest {
  static_assert(std::is_trivially_copyable_v<T>, "Latest copies plain values");

 public:
  /// Writer only.
  void write(const T& value) noexcept {
    slots_[writing_] = value;
    publish();
  }
  /// Writer only: a value too large to be made elsewhere is made here, over an old one; nobody sees it before
  /// publish().
  [[nodiscard]] T& draft() noexcept { return slots_[writing_]; }
  void publish() noexcept {
    const std::uint32_t previous = shared_.exchange(writing_ | kFresh, std::memory_order_acq_rel);
    writing_ = previous & kIndex;
  }

  /// Reader only: the newest complete value; the default value before the first write.
  [[nodiscard]] const T& read() noexcept {
    if ((shared_.load(std::memory_order_acquire) & kFresh) != 0) {
      const std::uint32_t previous = shared_.exchange(reading_, std::memory_order_acq_rel);
      reading_ = previous & kIndex;
    }
    return slots_[reading_];
  }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kFresh = 4;
  std::array<T, 3> slots_{};
  std::uint32_t writing_ = 0;
  std::atomic<std::uint32_t> shared_{1};
  std::uint32_t reading_ = 2;
};

}  // namespace ivo
