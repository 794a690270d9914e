// The motor of a simulated drive: a velocity that ramps, the position that it integrates to, and how far the rim of the
// wheel really went; in whole numbers throughout, so that the same commands give the same counts everywhere.
#pragma once

#include <cstdint>

#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::drivers {

/// Velocities in the drive's units (60FFh), accelerations in those units a second.
class SimMotion {
 public:
  struct Ramp {
    std::uint32_t up = 0;    ///< speeding up
    std::uint32_t down = 0;  ///< slowing down
  };

  explicit SimMotion(const DriveParameters& drive) noexcept;

  /// Lets whole microseconds of `time` pass while velocity goes to `target` along `ramp`. Cost: one step a millisecond.
  void advance(Duration time, std::int32_t target, Ramp ramp) noexcept;
  /// Something holds the wheel: it stands at once.
  void block() noexcept { velocity_micro_ = 0; }
  /// Of what the motor turns the rim misses `per_mille`, up to 1000, from now on.
  void set_slip(std::uint32_t per_mille) noexcept { slip_per_mille_ = per_mille < 1000 ? per_mille : 1000; }

  [[nodiscard]] std::int32_t velocity() const noexcept;
  [[nodiscard]] std::int32_t position() const noexcept;  ///< counts, wraps at 32 bits
  /// How far the rim went over the ground, in counts of the motor that would have turned it so.
  [[nodiscard]] std::int64_t rim_counts() const noexcept { return counts_ - slipped_per_mille_ / 1000; }
  [[nodiscard]] bool at_rest() const noexcept { return velocity_micro_ == 0; }

 private:
  void step(std::int64_t time_us, std::int64_t target_micro, Ramp ramp) noexcept;

  std::int64_t counts_per_unit_ppm_;  // counts a second for one unit of velocity, in millionths
  std::int64_t fastest_micro_;        // beyond, one step would not fit into 64 bits
  std::int64_t velocity_micro_ = 0;   // millionths of a unit
  std::int64_t path_rest_ = 0;        // in 1/2000 of 1e-9 unit seconds
  std::int64_t count_rest_ = 0;       // in 1e-15 counts
  std::int64_t counts_ = 0;
  std::int64_t slipped_per_mille_ = 0;  // in 1/1000 counts
  std::int64_t slip_per_mille_ = 0;
};

}  // namespace ivo::drivers
