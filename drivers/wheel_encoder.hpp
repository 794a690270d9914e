// A wheel's angle and speed from the drive's position 6064h, which counts in 32 bits and wraps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "config/base/time.hpp"
#include "config/rates.hpp"
#include "config/robot.hpp"

namespace ivo::drivers {

/// At rest, over the last rates::kStandstillDwell, is a wheel
/// - whose positions all lie within kRestSpanM of each other at the rim (it may shiver), and
/// - that went no further from end to end than kRestSpeedMps would take it (it does not creep),
/// or within one count, whichever is more: a coarse encoder flickers by one count, a fine one by many that mean
/// nothing. With a count of more than 0.5 mm at the rim a wheel slower than one count in the dwell cannot be told from
/// one at rest.
///
/// Speed is the mean over the last kWindow samples (14 ms without losses): one count in one cycle would read as 0.8
/// rad/s at the motor with 4096 counts. Angle is exact: a lost sample loses no distance, less than half a wrap apart.
class WheelEncoder {
 public:
  static constexpr std::size_t kWindow = 8;
  static constexpr double kRestSpanM = 0.002;
  static constexpr double kRestSpeedMps = 0.010;

  /// `wheel_radius_m` is positive.
  WheelEncoder(const DriveParameters& drive, double wheel_radius_m) noexcept;

  /// The position sampled at `when`. The first sample after construction is angle 0.
  void sample(std::int32_t position, Instant when) noexcept;
  /// The next sample continues at the present angle, whatever its position: the drive has rebooted.
  void rebase() noexcept;

  [[nodiscard]] double angle_rad() const noexcept { return static_cast<double>(counts_) * rad_per_count_; }
  [[nodiscard]] double radps() const noexcept;
  /// At rest, as said above, up to the last sample. Cost: a look at no more than kHistory samples.
  [[nodiscard]] bool still() const noexcept;

 private:
  static constexpr std::size_t kHistory = 64;
  static_assert(kHistory * rates::kShortestCycle > rates::kStandstillDwell + 4 * rates::kShortestCycle,
                "the dwell, and some jitter");

  struct Sample {
    std::int64_t counts = 0;
    Instant when{};
  };

  [[nodiscard]] const Sample& before_last(std::size_t n) const noexcept {
    return samples_[(sampled_ - 1 - n) % kHistory];
  }

  double rad_per_count_;      // at the wheel, signed
  double rest_span_counts_;   // at rest, no two positions lie further apart
  double rest_drift_counts_;  // at rest, first and last position lie no further apart
  bool based_ = false;
  std::int32_t position_ = 0;
  std::int64_t counts_ = 0;
  std::array<Sample, kHistory> samples_{};
  std::size_t sampled_ = 0;  // samples since rebase
};

}  // namespace ivo::drivers
