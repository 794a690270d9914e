#include "drivers/wheel_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "config/base/contract.hpp"

namespace ivo::drivers {

WheelEncoder::WheelEncoder(const DriveParameters& drive, double wheel_radius_m) noexcept
    : rad_per_count_(drive.sign * 2.0 * std::numbers::pi / (drive.counts_per_turn * drive.gear_ratio)) {
  IVO_CONTRACT(wheel_radius_m > 0.0);
  const double m_per_count = std::abs(rad_per_count_) * wheel_radius_m;
  rest_span_counts_ = std::max(1.0, kRestSpanM / m_per_count);
  rest_drift_counts_ = std::max(1.0, kRestSpeedMps * seconds(rates::kStandstillDwell) / m_per_count);
}

void WheelEncoder::sample(std::int32_t position, Instant when) noexcept {
  if (based_) {
    const auto moved = std::bit_cast<std::uint32_t>(position) - std::bit_cast<std::uint32_t>(position_);
    counts_ += std::bit_cast<std::int32_t>(moved);
  }
  position_ = position;
  based_ = true;
  samples_[sampled_++ % kHistory] = {counts_, when};
}

void WheelEncoder::rebase() noexcept {
  based_ = false;
  sampled_ = 0;
}

double WheelEncoder::radps() const noexcept {
  if (sampled_ < 2) {
    return 0.0;
  }
  const Sample& newest = before_last(0);
  const Sample& oldest = before_last(std::min(sampled_, kWindow) - 1);
  const double time_s = seconds(newest.when - oldest.when);
  return time_s > 0.0 ? static_cast<double>(newest.counts - oldest.counts) * rad_per_count_ / time_s : 0.0;
}

bool WheelEncoder::still() const noexcept {
  std::int64_t lowest = counts_;
  std::int64_t highest = counts_;
  for (std::size_t n = 0; n < std::min(sampled_, kHistory); ++n) {
    const Sample& sample = before_last(n);
    lowest = std::min(lowest, sample.counts);
    highest = std::max(highest, sample.counts);
    if (static_cast<double>(highest - lowest) > rest_span_counts_) {
      return false;
    }
    if (before_last(0).when - sample.when >= rates::kStandstillDwell) {
      return static_cast<double>(std::abs(counts_ - sample.counts)) <= rest_drift_counts_;
    }
  }
  return false;
}

}  // namespace ivo::drivers
