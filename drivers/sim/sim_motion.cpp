#include "drivers/sim/sim_motion.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>

namespace ivo::drivers {
namespace {

constexpr std::int64_t kMillion = 1'000'000;
constexpr std::int64_t kStepUs = 1000;
constexpr std::int64_t kPathPerNano = 2000;                  // see path_rest_
constexpr std::int64_t kCountParts = 1'000'000'000'000'000;  // see count_rest_
constexpr std::int64_t kFastestCountsPerSecond =
    8'000'000'000'000;  // in millionths: 8e6 counts/s for 1 ms stay below 2^63

}  // namespace

SimMotion::SimMotion(const DriveParameters& drive) noexcept
    : counts_per_unit_ppm_(
          std::llround(drive.counts_per_turn / (2.0 * std::numbers::pi * drive.velocity_per_radps) * 1e6)),
      fastest_micro_(kFastestCountsPerSecond / std::max<std::int64_t>(counts_per_unit_ppm_, 1) * kMillion) {}

void SimMotion::advance(Duration time, std::int32_t target, Ramp ramp) noexcept {
  const std::int64_t target_micro = std::clamp(target * kMillion, -fastest_micro_, fastest_micro_);
  std::int64_t left_us = std::chrono::duration_cast<std::chrono::microseconds>(time).count();
  while (left_us > 0) {
    const std::int64_t step_us = std::min(left_us, kStepUs);
    step(step_us, target_micro, ramp);
    left_us -= step_us;
  }
}

void SimMotion::step(std::int64_t time_us, std::int64_t target_micro, Ramp ramp) noexcept {
  const bool speeding_up = velocity_micro_ >= 0 ? target_micro > velocity_micro_ : target_micro < velocity_micro_;
  const std::int64_t change = time_us * (speeding_up ? ramp.up : ramp.down);
  const std::int64_t before = velocity_micro_;
  velocity_micro_ = std::clamp(target_micro, before - change, before + change);

  path_rest_ += (before + velocity_micro_) * time_us;
  count_rest_ += path_rest_ / kPathPerNano * counts_per_unit_ppm_;
  path_rest_ %= kPathPerNano;
  const std::int64_t turned = count_rest_ / kCountParts;
  counts_ += turned;
  slipped_per_mille_ += turned * slip_per_mille_;
  count_rest_ %= kCountParts;
}

std::int32_t SimMotion::velocity() const noexcept { return static_cast<std::int32_t>(velocity_micro_ / kMillion); }

std::int32_t SimMotion::position() const noexcept {
  return std::bit_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(counts_)));
}

}  // namespace ivo::drivers
