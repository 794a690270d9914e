#include "firmware/tools/wheels/turn_measure.hpp"

#include <cmath>
#include <numbers>

namespace ivo::firmware {

TurnMeasure::Scale TurnMeasure::scale_of(const DriveParameters& drive) noexcept {
  const double motor = drive.sign * drive.gear_ratio;  // turns for one of the wheel
  return {.units_per_radps = motor * drive.velocity_per_radps,
          .counts_per_rad = motor * drive.counts_per_turn / (2.0 * std::numbers::pi)};
}

void TurnMeasure::begin(Wheel wheel, const Scale& scale, double expected,
                        const std::array<double, kWheels>& angles_rad) noexcept {
  *this = TurnMeasure();
  wheel_ = wheel;
  scale_ = scale;
  expected_ = expected;
  begin_rad_ = angles_rad[static_cast<std::size_t>(wheel)];
  others_from_rad_ = angles_rad;
}

void TurnMeasure::update(const Cycle& cycle) noexcept {
  result_.told_units = static_cast<std::int32_t>(std::lround(cycle.told_radps * scale_.units_per_radps));
  result_.told_radps = result_.told_units == 0 ? 0.0 : result_.told_units / scale_.units_per_radps;
  result_.told_rad += result_.told_radps * seconds(cycle.dt);
  result_.rad = cycle.angles_rad[static_cast<std::size_t>(wheel_)] - begin_rad_;
  result_.counts = std::llround(result_.rad * scale_.counts_per_rad);
  if (result_.told_units == 0) {
    others_from_rad_ = cycle.angles_rad;
  }
  take_sample(cycle.now);
  measure_steady(cycle.now);
  look_for_oddness(cycle);
}

void TurnMeasure::forget_note() noexcept {
  result_.note = TurnNote::kNone;
  told_from_rad_ = result_.told_rad;
  from_rad_ = result_.rad;
}

void TurnMeasure::take_sample(Instant now) noexcept {
  samples_[sampled_++ % kSamples] = {now, result_.rad};
  while (sampled_ - oldest_ > kSamples || now - samples_[oldest_ % kSamples].when > kWindow) {
    ++oldest_;
  }
  const Sample& oldest = samples_[oldest_ % kSamples];
  const double time_s = seconds(now - oldest.when);
  result_.radps = time_s > 0.0 ? (result_.rad - oldest.rad) / time_s : 0.0;
}

void TurnMeasure::measure_steady(Instant now) noexcept {
  if (result_.told_radps != steady_told_radps_) {
    steady_told_radps_ = result_.told_radps;
    steady_since_ = now;
  }
  const Duration time = now - steady_since_ - kSteadyAfter;
  if (result_.told_units == 0 || time < Duration::zero()) {
    steady_from_rad_ = result_.rad;
    return;
  }
  if (time == Duration::zero()) {
    steady_from_rad_ = result_.rad;
  }
  if (time >= kWindow && time > result_.steady) {
    result_.steady = time;
    result_.steady_told_radps = result_.told_radps;
    result_.steady_radps = (result_.rad - steady_from_rad_) / seconds(time);
  }
}

void TurnMeasure::look_for_oddness(const Cycle& cycle) noexcept {
  if (std::abs(result_.told_radps) >= peak_radps_ || cycle.now - peak_at_ > kForgives) {
    peak_radps_ = std::abs(result_.told_radps);
    peak_at_ = cycle.now;
  }
  const Sample& oldest = samples_[oldest_ % kSamples];
  const double window_s = seconds(cycle.now - oldest.when);
  const double margin_rad = kTooFastMarginRad + 2.0 / std::abs(scale_.counts_per_rad);
  const double told_rad = result_.told_rad - told_from_rad_;
  const double went_rad = result_.rad - from_rad_;
  if (std::abs(result_.rad - oldest.rad) > kTooFast * expected_ * peak_radps_ * window_s + margin_rad) {
    remark(TurnNote::kTooFast, wheel_);
  } else if (went_rad * told_rad < 0.0 && std::abs(went_rad) > margin_rad) {
    remark(TurnNote::kAgainst, wheel_);
  } else if (std::abs(told_rad) > kStaysAfterRad && std::abs(went_rad) < 0.1 * kStaysAfterRad) {
    remark(TurnNote::kStays, wheel_);
  }
  for (std::size_t i = 0; i < cycle.angles_rad.size(); ++i) {
    if (i != static_cast<std::size_t>(wheel_) && std::abs(cycle.angles_rad[i] - others_from_rad_[i]) > kOtherRad) {
      remark(TurnNote::kOtherMoves, static_cast<Wheel>(i));
    }
  }
}

void TurnMeasure::remark(TurnNote note, Wheel wheel) noexcept {
  if (result_.note == TurnNote::kNone) {
    result_.note = note;
    result_.note_wheel = wheel;
  }
}

}  // namespace ivo::firmware
