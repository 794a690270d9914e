#include "firmware/motion/slip_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "config/base/contract.hpp"

namespace ivo::firmware {
namespace {

// Twice the unit left-null vector (FL, FR, RL, RR): its own inverse, entry by entry.
constexpr WheelValues kNull{1.0, 1.0, -1.0, -1.0};

// A wheel alone that is off by off_mps explains the residual; taken back, the four are a motion of the body, which lies
// some way from the commanded one. The sum of squares of that way differs between the wheels only in this term.
Wheel nearest_to_command(const WheelValues& ahead_mps, const WheelValues& off_mps) noexcept {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ahead_mps.size(); ++i) {
    const double change = std::pow(ahead_mps[i] - off_mps[i], 2) - std::pow(ahead_mps[i], 2);
    if (change < least) {
      least = change;
      best = i;
    }
  }
  return static_cast<Wheel>(best);
}

}  // namespace

SlipMonitor::SlipMonitor(const Kinematics& kinematics, double wheel_radius_m, const SlipParameters& parameters) noexcept
    : kinematics_(kinematics), wheel_radius_m_(wheel_radius_m), parameters_(parameters) {
  IVO_CONTRACT(wheel_radius_m > 0 && parameters.wheel_sigma_mps > 0 && parameters.share > 0 &&
               parameters.limit_sigma > 0 && parameters.cycles > 0);
}

const SlipHealth& SlipMonitor::update(const Reading& reading) noexcept {
  double fastest_mps = 0.0;
  WheelValues ahead_mps{};
  for (std::size_t i = 0; i < ahead_mps.size(); ++i) {
    fastest_mps = std::max(fastest_mps, wheel_radius_m_ * std::abs(reading.measured_radps[i]));
    ahead_mps[i] = wheel_radius_m_ * (reading.measured_radps[i] - reading.commanded_radps[i]);
  }
  health_.residual_mps = kinematics_.slip_residual_mps(reading.measured_radps);
  health_.sigma_mps = std::hypot(parameters_.wheel_sigma_mps, parameters_.share * fastest_mps);
  const double beyond_mps = std::abs(health_.residual_mps) - std::max(0.0, reading.explained_mps);
  health_.normalised = std::max(0.0, beyond_mps) / health_.sigma_mps;
  for (std::size_t i = 0; i < ahead_mps.size(); ++i) {
    health_.off_mps[i] = 2.0 * kNull[i] * health_.residual_mps;
  }
  health_.suspect = nearest_to_command(ahead_mps, health_.off_mps);
  // Asked this way round, what is not a number is beyond.
  const bool within = std::isfinite(health_.residual_mps) && health_.normalised <= parameters_.limit_sigma;
  health_.cycles = within ? 0 : std::min(health_.cycles + 1, parameters_.cycles);
  health_.slipping = health_.cycles >= parameters_.cycles;
  return health_;
}

}  // namespace ivo::firmware
