// Drives an omnidirectional base along a polyline while it holds its heading.
#pragma once

#include <span>

#include "config/base/geometry.hpp"
#include "config/base/time.hpp"
#include "config/robot.hpp"
#include "firmware/motion/path_progress.hpp"
#include "firmware/motion/speed_profile.hpp"

namespace ivo::firmware {

/// In the frame of the path: along it no faster than corners and the end ahead allow, and across it back towards it.
/// Further than 0.10 m off the path the robot returns to it before it goes on. What comes out keeps to the speed and
/// acceleration limits, so a Limiter behind it changes nothing.
class PathFollower {
 public:
  struct Input {
    Pose pose;     ///< in the frame of the path
    Twist moving;  ///< the twist last sent to the wheels, whoever chose it
    Duration dt{};
  };
  struct Output {
    Twist command;                 ///< body frame
    double distance_left_m = 0.0;  ///< along the path, never growing
    double cross_track_m = 0.0;    ///< from the line of the leg being followed, positive to the left of it
    bool reached = false;          ///< within kEndTolerance_m of the end and slow; stays until the next start()
  };

  static constexpr double kEndTolerance_m = 0.05;

  explicit PathFollower(const MotionLimits& limits) noexcept : limits_(limits), profile_(limits) {}

  /// Follows `path` from where the robot is, with the heading it has now. The points stay the caller's and must outlive
  /// the following. Points that repeat count once. False when the path is empty or a number is not finite: then there
  /// is no path and commands are 0. Cost: one pass over the points.
  [[nodiscard]] bool start(std::span<const Point> path, const Pose& pose) noexcept;

  /// Goes on along `path` with `left_m` of it to go, holding the heading `heading_rad`; else as start(). The robot is
  /// at `pose`, which may be beside the path: it returns to it.
  [[nodiscard]] bool resume(std::span<const Point> path, const Pose& pose, double heading_rad, double left_m) noexcept;

  /// One cycle. Without a path, or with a pose that is not finite, the command is 0. Cost: at most twice
  /// PathProgress::kLegsPerCycle legs, whatever the path's length.
  [[nodiscard]] Output update(const Input& input) noexcept;

 private:
  [[nodiscard]] Twist command(const Input& input) const noexcept;
  [[nodiscard]] double along_mps() const noexcept;
  [[nodiscard]] double across_mps() const noexcept;
  [[nodiscard]] double turn_radps(const Input& input) const noexcept;

  MotionLimits limits_;
  SpeedProfile profile_;
  PathProgress progress_;
  double heading_rad_ = 0.0;
  bool reached_ = false;
};

}  // namespace ivo::firmware
