// The motor of a simulated drive: a velocity that ramps and the position that it integrates to, in whole numbers
// throughout, so that the same commands give the same counts everywhere.
#pragma once

#include <cstdint>

#include "config/base/time.hpp"
#include "config/robot.hpp"

namespace ivo::drivers {

/// Velocities in the drive's units (60FFh), accelerations in those units a second (6083h).
class SimMotion {
 public:
  struct Ramp {
    std::uint32_t up = 0;    ///< speeding up
    std::uint32_t down = 0;  ///< slowing down
  };

  explicit SimMotion(const DriveParameters& drive) noexcept;

  /// Lets whole microseconds of `time` pass while velocity goes to `target` along `ramp`. Cost: one step a millisecond.
  void advance(Duration time, std::int32_t target, Ramp ramp) noexcept;

  [[nodiscard]] std::int32_t velocity() const noexcept;
  [[nodiscard]] std::int32_t position() const noexcept;  ///< counts, wraps at 32 bits
  [[nodiscard]] bool at_rest() const noexcept { return velocity_micro_ == 0; }

 private:
  void step(std::int64_t time_us, std::int64_t target_micro, Ramp ramp) noexcept;

  std::int64_t counts_per_unit_ppm_;  // counts a second for one unit of velocity, in millionths
  std::int64_t fastest_micro_;        // beyond, one step would not fit into 64 bits
  std::int64_t velocity_micro_ = 0;   // millionths of a unit
  std::int64_t path_rest_ = 0;        // in 1/2000 of 1e-9 unit seconds
  std::int64_t count_rest_ = 0;       // in 1e-15 counts
  std::int64_t counts_ = 0;
};

}  // namespace ivo::drivers
