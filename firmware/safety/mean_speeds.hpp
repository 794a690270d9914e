// Mean speeds of the wheels over a while, from their angles: what a coarse encoder says within one cycle means little.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "config/base/time.hpp"
#include "firmware/motion/kinematics.hpp"

namespace ivo::firmware {

class MeanSpeeds {
 public:
  /// Over the last `over`, or as much as there was since reset().
  explicit MeanSpeeds(Duration over) noexcept : span_(over / static_cast<Duration::rep>(kSamples - 1)) {}

  void reset() noexcept { taken_ = 0; }

  void update(const WheelValues& angles_rad, Instant now) noexcept {
    if (taken_ == 0 || now - newest().when >= span_) {
      samples_[taken_++ % kSamples] = {now, angles_rad};
    }
    const Sample& oldest = samples_[taken_ > kSamples ? taken_ % kSamples : 0];
    time_ = now - oldest.when;
    for (std::size_t i = 0; i < radps_.size(); ++i) {
      radps_[i] = time_ > Duration::zero() ? (angles_rad[i] - oldest.angles_rad[i]) / seconds(time_) : 0.0;
    }
  }

  /// 0 before there were two angles.
  [[nodiscard]] const WheelValues& radps() const noexcept { return radps_; }
  /// They are means over the time asked for and no more than half as much again: not since reset(), nor when cycles
  /// were late.
  [[nodiscard]] bool whole() const noexcept {
    const Duration asked = static_cast<Duration::rep>(kSamples - 1) * span_;
    return time_ >= asked && time_ <= asked + asked / 2;
  }

 private:
  static constexpr std::size_t kSamples = 11;
  struct Sample {
    Instant when{};
    WheelValues angles_rad{};
  };
  [[nodiscard]] const Sample& newest() const noexcept { return samples_[(taken_ - 1) % kSamples]; }

  Duration span_;
  std::array<Sample, kSamples> samples_{};
  std::size_t taken_ = 0;
  Duration time_{};
  WheelValues radps_{};
};

}  // namespace ivo::firmware
