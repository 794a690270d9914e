#include "firmware/safety/wheel_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace ivo::firmware {
namespace {

using namespace wheel_limits;

double metres_a_count(const DriveParameters& drive, double radius_m) noexcept {
  return 2.0 * std::numbers::pi * radius_m / (drive.counts_per_turn * drive.gear_ratio);
}

SlipParameters slip_parameters(const Robot& robot) noexcept {
  // Two readings, each to a whole count: variance of a count squared over 6, spread over the time of the mean.
  double coarsest_m = 0.0;
  for (const DriveParameters& drive : robot.drives) {
    coarsest_m = std::max(coarsest_m, metres_a_count(drive, robot.base.wheel_radius_m));
  }
  const double counting_mps = coarsest_m / std::sqrt(6.0) / seconds(kMean);
  return {.wheel_sigma_mps = std::hypot(kSlipSigmaMps, counting_mps),
          .share = kSlipShare,
          .limit_sigma = kSlipSigmas,
          .cycles = static_cast<int>(kSlipTime / robot.cycle)};
}

std::uint32_t millimetres_a_second(double speed_mps) noexcept {
  const double mmps = std::abs(speed_mps) * 1000.0;
  return std::isfinite(mmps) ? static_cast<std::uint32_t>(std::min(mmps, 1e6)) : 1'000'000U;
}

}  // namespace

WheelMonitor::WheelMonitor(const Robot& robot) noexcept
    : radius_m_(robot.base.wheel_radius_m),
      longest_step_(2 * robot.cycle),
      wheels_{[&]() noexcept {
        const WheelState state{SpeedEnvelope(kLag, robot.limits.max_accel_mps2),
                               SpeedEnvelope(kLag + kMean, robot.limits.max_accel_mps2)};
        return std::array<WheelState, kWheels>{state, state, state, state};
      }()},
      slip_(Kinematics(robot.base), robot.base.wheel_radius_m, slip_parameters(robot)) {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    wheels_[i].count_m = metres_a_count(robot.drives[i], radius_m_);
    node_ids_[i] = robot.drives[i].node_id;
  }
}

std::optional<drivers::DriveFault> WheelMonitor::update(const Reading& reading, Instant now) noexcept {
  if (!reading.enabled || !enabled_) {
    reset(reading, now);
  }
  enabled_ = reading.enabled;
  if (!enabled_) {
    return std::nullopt;
  }
  // In a late cycle the feedback is from before the gap: what was missed says nothing of the wheels.
  const double dt_s = seconds(std::min(now - before_, longest_step_));
  before_ = now;
  speeds_.update(reading.angle_rad, now);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    look_at(i, reading, now, dt_s);
  }
  look_for_slip(reading);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    if (stuck(i)) {
      return drivers::DriveFault{
          .reason = drivers::DriveFaultReason::kEncoderStuck, .node_id = node_ids_[i], .wheel = static_cast<Wheel>(i)};
    }
  }
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    if (not_following(i, now)) {
      return drivers::DriveFault{.reason = drivers::DriveFaultReason::kWheelNotFollowing,
                                 .node_id = node_ids_[i],
                                 .wheel = static_cast<Wheel>(i),
                                 .code = millimetres_a_second(health_[i].outside_mps)};
    }
  }
  if (slip_.health().slipping) {
    return drivers::DriveFault{.reason = drivers::DriveFaultReason::kWheelSlip,
                               .wheel = slip_.health().suspect,
                               .code = millimetres_a_second(slip_.health().residual_mps)};
  }
  return std::nullopt;
}

void WheelMonitor::reset(const Reading& reading, Instant now) noexcept {
  speeds_.reset();
  slip_.reset();
  health_ = {};
  before_ = now;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    wheels_[i].stuck.reset(now);
    wheels_[i].mean.reset(now);
    wheels_[i].moved_rad = reading.angle_rad[i];
    wheels_[i].off_since.reset();
  }
}

void WheelMonitor::look_at(std::size_t wheel, const Reading& reading, Instant now, double dt_s) noexcept {
  WheelState& state = wheels_[wheel];
  WheelHealth& health = health_[wheel];
  const double told_mps = radius_m_ * reading.told_radps[wheel];
  state.stuck.update(told_mps, now);
  state.mean.update(told_mps, now);

  const double least_mps = state.stuck.least_mps();
  const double moved_m = radius_m_ * std::abs(reading.angle_rad[wheel] - state.moved_rad);
  // There and back again a wheel of a coarse encoder may well be where it was.
  const bool turned_round = least_mps * health.stuck_way_m < 0.0;
  if (moved_m > std::max(kMovedM, kMovedCounts * state.count_m) || turned_round) {
    state.moved_rad = reading.angle_rad[wheel];
    health.stuck_way_m = 0.0;
  } else if (std::abs(least_mps) >= kStuckFloorMps) {
    health.stuck_way_m += least_mps * dt_s;
  }

  health.speed_mps = radius_m_ * speeds_.radps()[wheel];
  health.outside_mps = speeds_.whole() ? state.mean.outside_mps(health.speed_mps) : 0.0;
  const double counting_mps = state.count_m / seconds(kMean);
  health.normalised = health.outside_mps / (kOffMps + kOffShare * state.mean.most_mps() + counting_mps);
  // Asked this way round, what is not a number is off.
  if (health.normalised <= 1.0) {
    state.off_since.reset();
  } else if (!state.off_since) {
    state.off_since = now;
  }
}

// Drives on ramps, or with lags of their own, need not agree with each other: as far as their envelopes let the
// residual go it is explained.
void WheelMonitor::look_for_slip(const Reading& reading) noexcept {
  double low_mps = 0.0;
  double high_mps = 0.0;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const bool front = i < kWheels / 2;
    low_mps += 0.5 * (front ? wheels_[i].mean.low_mps() : -wheels_[i].mean.high_mps());
    high_mps += 0.5 * (front ? wheels_[i].mean.high_mps() : -wheels_[i].mean.low_mps());
  }
  if (!speeds_.whole()) {
    slip_.reset();
    return;
  }
  slip_.update({.measured_radps = speeds_.radps(),
                .commanded_radps = reading.told_radps,
                .explained_mps = std::max(std::abs(low_mps), std::abs(high_mps))});
}

bool WheelMonitor::stuck(std::size_t wheel) const noexcept {
  return std::abs(health_[wheel].stuck_way_m) >= std::max(kStuckWayM, kStuckCounts * wheels_[wheel].count_m);
}

bool WheelMonitor::not_following(std::size_t wheel, Instant now) const noexcept {
  return wheels_[wheel].off_since && now - *wheels_[wheel].off_since >= kOffTime;
}

}  // namespace ivo::firmware
