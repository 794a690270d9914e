// How regularly a drive's TPDO1 comes: one after each SYNC, neither missing nor double.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ivo::drivers {

/// Counts over the last kWindow SYNCs. A late TPDO1 counts twice: missing after its SYNC, double after the next.
class FeedbackTally {
 public:
  static constexpr std::size_t kWindow = 100;
  static constexpr std::uint32_t kMost = 20;  ///< beyond, feedback is erratic

  void forget() noexcept { *this = {}; }
  /// A SYNC goes out: closes the one before.
  void sync() noexcept {
    if (open_) {
      bool& slot = irregular_[next_++ % kWindow];
      count_ -= slot ? 1U : 0U;
      slot = heard_ != 1;
      count_ += slot ? 1U : 0U;
    }
    open_ = true;
    heard_ = 0;
  }
  void heard() noexcept { ++heard_; }

  /// SYNCs, of the last kWindow, that had no TPDO1 or several.
  [[nodiscard]] std::uint32_t irregular() const noexcept { return count_; }
  [[nodiscard]] bool erratic() const noexcept { return count_ > kMost; }

 private:
  std::array<bool, kWindow> irregular_{};
  std::size_t next_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t heard_ = 0;
  bool open_ = false;
};

}  // namespace ivo::drivers
