#include "drivers/wheel_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <numbers>

#include "config/rates.hpp"

namespace ivo::drivers {

WheelEncoder::WheelEncoder(const DriveParameters& drive) noexcept
    : rad_per_count_(drive.sign * 2.0 * std::numbers::pi / (drive.counts_per_turn * drive.gear_ratio)) {}

void WheelEncoder::sample(std::int32_t position, Instant when) noexcept {
  if (based_) {
    const auto moved = std::bit_cast<std::uint32_t>(position) - std::bit_cast<std::uint32_t>(position_);
    counts_ += std::bit_cast<std::int32_t>(moved);
  }
  position_ = position;
  if (!based_ || std::abs(counts_ - rest_.counts) > 1) {
    rest_ = {counts_, when};
  }
  based_ = true;
  samples_[sampled_++ % kWindow] = {counts_, when};
}

void WheelEncoder::rebase() noexcept {
  based_ = false;
  sampled_ = 0;
}

double WheelEncoder::radps() const noexcept {
  if (sampled_ < 2) {
    return 0.0;
  }
  const Sample& newest = samples_[(sampled_ - 1) % kWindow];
  const Sample& oldest = samples_[sampled_ < kWindow ? 0 : sampled_ % kWindow];
  const double time_s = seconds(newest.when - oldest.when);
  return time_s > 0.0 ? static_cast<double>(newest.counts - oldest.counts) * rad_per_count_ / time_s : 0.0;
}

bool WheelEncoder::still() const noexcept {
  return sampled_ > 0 && samples_[(sampled_ - 1) % kWindow].when - rest_.when >= rates::kStandstillDwell;
}

}  // namespace ivo::drivers
