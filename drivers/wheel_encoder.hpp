// A wheel's angle and speed from the drive's position 6064h, which counts in 32 bits and wraps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::drivers {

/// Speed is the mean over the last kWindow samples (14 ms without losses): one count in one cycle would read as 0.8
/// rad/s at the motor with 4096 counts. Angle is exact: a lost sample loses no distance, less than half a wrap apart.
class WheelEncoder {
 public:
  static constexpr std::size_t kWindow = 8;

  explicit WheelEncoder(const DriveParameters& drive) noexcept;

  /// The position sampled at `when`. The first sample after construction is angle 0.
  void sample(std::int32_t position, Instant when) noexcept;
  /// The next sample continues at the present angle, whatever its position: the drive has rebooted.
  void rebase() noexcept;

  [[nodiscard]] double angle_rad() const noexcept { return static_cast<double>(counts_) * rad_per_count_; }
  [[nodiscard]] double radps() const noexcept;
  /// Moved by no more than one count for rates::kStandstillDwell before the last sample.
  [[nodiscard]] bool still() const noexcept;

 private:
  struct Sample {
    std::int64_t counts = 0;
    Instant when{};
  };

  double rad_per_count_;  // at the wheel, signed
  bool based_ = false;
  std::int32_t position_ = 0;
  std::int64_t counts_ = 0;
  std::array<Sample, kWindow> samples_{};
  std::size_t sampled_ = 0;  // samples since rebase
  Sample rest_;              // where and since when the wheel rests
};

}  // namespace ivo::drivers
