// Do the wheels do what they are told? Each cycle a verdict for the stop path: nothing, or the fault with the wheel.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "drivers/drive_fault.hpp"
#include "firmware/motion/kinematics.hpp"
#include "firmware/motion/slip_monitor.hpp"
#include "firmware/safety/mean_speeds.hpp"
#include "firmware/safety/speed_envelope.hpp"

namespace ivo::firmware {

/// How far a wheel may be from what it is told. Speeds and ways are at the rim.
namespace wheel_limits {
using std::chrono_literals::operator""ms;

/// SYNC to feedback 2 cycles, the drive's speed loop and filter up to some 100 ms, and half as much again.
inline constexpr Duration kLag = 150ms;
/// Speeds are means over so long: a count of 5 mm is then 50 mm/s, below the tolerance.
inline constexpr Duration kMean = 100ms;

/// Told to go so far at the least, and not moved: the encoder, its coupling, or a blocked wheel. At 0.4 m/s that is 75
/// ms, at a crawl of 5 cm/s 0.6 s, in which friction has let go of any wheel.
inline constexpr double kStuckWayM = 0.030;
inline constexpr double kStuckCounts = 4.0;      ///< or so many counts, of an encoder coarser than that
inline constexpr double kMovedM = 0.002;         ///< less is shivering (as WheelEncoder::kRestSpanM) ...
inline constexpr double kMovedCounts = 1.5;      ///< ... or the flicker of one count
inline constexpr double kStuckFloorMps = 0.010;  ///< slower than this nothing is told to go anywhere

/// A mean speed so far outside of what drive, ramp and lag explain, and so long, is not a drive that does its work: it
/// may overshoot by a quarter, and a doorstep holds a wheel for a moment.
inline constexpr double kOffMps = 0.080;
inline constexpr double kOffShare = 0.25;  ///< of the speed told
inline constexpr Duration kOffTime = 150ms;

/// Slip of several wheels at once, each too little to stand out (slip_monitor.hpp).
inline constexpr double kSlipSigmaMps = 0.010;
inline constexpr double kSlipShare = 0.040;
inline constexpr double kSlipSigmas = 6.0;
inline constexpr Duration kSlipTime = 200ms;
}  // namespace wheel_limits

class WheelMonitor {
 public:
  struct Reading {
    WheelValues told_radps{};  ///< as sent in the last cycle
    WheelValues angle_rad{};   ///< unwrapped, the newest feedback
    bool enabled = false;      ///< all four drives hold their speed under power
  };
  struct WheelHealth {
    double speed_mps = 0.0;    ///< mean over wheel_limits::kMean
    double outside_mps = 0.0;  ///< of what the commands explain
    double normalised = 0.0;   ///< outside_mps over what is tolerated at this speed: above 1 for long is a fault
    double stuck_way_m = 0.0;  ///< that it was told to go, one way, since it last moved
  };

  /// Drives are set to ramps (6083h, 6084h) no gentler than limits.max_accel_mps2.
  explicit WheelMonitor(const Robot& robot) noexcept;

  /// One cycle; `now` never goes back. While not enabled nothing is judged, and everything before is forgotten.
  ///   kEncoderStuck       the wheel was told to go some way, and its position stays
  ///   kWheelNotFollowing  the wheel turns otherwise than told; code: mm/s
  ///   kWheelSlip          the four turn as no body can move; code: residual in mm/s, wheel: the likeliest
  /// The verdict stands for as long as the wheels go on so; whoever gets it latches it. Cost: some 100 comparisons.
  [[nodiscard]] std::optional<drivers::DriveFault> update(const Reading& reading, Instant now) noexcept;

  [[nodiscard]] const std::array<WheelHealth, kWheels>& health() const noexcept { return health_; }
  [[nodiscard]] const SlipHealth& slip() const noexcept { return slip_.health(); }

 private:
  struct WheelState {
    SpeedEnvelope stuck;  // of what it does now
    SpeedEnvelope mean;   // of what its mean speed is
    double count_m = 0.0;
    double moved_rad = 0.0;  // where it was when it last moved
    std::optional<Instant> off_since{};
  };

  void reset(const Reading& reading, Instant now) noexcept;
  void look_at(std::size_t wheel, const Reading& reading, Instant now, double dt_s) noexcept;
  void look_for_slip(const Reading& reading) noexcept;
  [[nodiscard]] bool stuck(std::size_t wheel) const noexcept;
  [[nodiscard]] bool not_following(std::size_t wheel, Instant now) const noexcept;

  double radius_m_;
  Duration longest_step_;
  std::array<std::uint8_t, kWheels> node_ids_{};
  std::array<WheelState, kWheels> wheels_;
  std::array<WheelHealth, kWheels> health_{};
  MeanSpeeds speeds_{wheel_limits::kMean};
  SlipMonitor slip_;
  bool enabled_ = false;
  Instant before_{};
};

}  // namespace ivo::firmware
