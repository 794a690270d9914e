// Wheels that turn as no body can move: four speeds, three of motion, and one equation left over that must hold.
#pragma once

#include <array>

#include "firmware/motion/kinematics.hpp"

namespace ivo::firmware {

struct SlipParameters {
  double wheel_sigma_mps = 0.01;  ///< standard deviation of one wheel's measured speed at its rim, at any speed
  double share = 0.04;            ///< of the fastest wheel's speed on top: radii, floor and tread are not all alike
  double limit_sigma = 6.0;       ///< a residual beyond so many standard deviations ...
  int cycles = 100;               ///< ... in so many cycles in a row is slip
};

struct SlipHealth {
  double residual_mps = 0.0;  ///< Kinematics::slip_residual_mps of what was measured
  double sigma_mps = 0.0;     ///< its standard deviation: that of one wheel, since the left-null vector has length 1
  double normalised = 0.0;    ///< how far |residual| lies beyond what is explained, in standard deviations; not below 0
  /// By how much each wheel alone would have to be off (m/s at the rim) to explain the residual: four alternatives of
  /// one size, for one equation does not tell which wheel slips.
  WheelValues off_mps{};
  /// Of the four, the one that leaves the rest nearest to what was commanded: a guess, good when one wheel alone is
  /// off.
  Wheel suspect = Wheel::kFrontLeft;
  int cycles = 0;  ///< in a row beyond the limit, up to SlipParameters::cycles
  bool slipping = false;
};

class SlipMonitor {
 public:
  struct Reading {
    WheelValues measured_radps{};
    WheelValues commanded_radps{};
    double explained_mps = 0.0;  ///< of the residual's size: drives on their ramps need not agree
  };

  /// Parameters are above 0 (contract).
  SlipMonitor(const Kinematics& kinematics, double wheel_radius_m, const SlipParameters& parameters) noexcept;

  /// One cycle. A speed that is not finite counts as beyond the limit.
  const SlipHealth& update(const Reading& reading) noexcept;
  void reset() noexcept { health_ = {}; }
  [[nodiscard]] const SlipHealth& health() const noexcept { return health_; }

 private:
  Kinematics kinematics_;
  double wheel_radius_m_;
  SlipParameters parameters_;
  SlipHealth health_;
};

}  // namespace ivo::firmware
