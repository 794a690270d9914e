// Where the robot is, from its wheels and from whoever else saw it: an extended Kalman filter on x, y and heading.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "config/base/geometry.hpp"
#include "config/base/time.hpp"

namespace ivo::firmware {

/// Of (x m, y m, heading rad) in the map frame.
using PoseCovariance = Eigen::Matrix3d;

/// What odometry gets wrong: variances that grow with the way and with the turn, whatever the number of steps.
struct OdometryNoise {
  double position_m2_per_m = 4e-4;     ///< 2 cm after a metre
  double position_m2_per_rad = 1e-4;   ///< 1 cm after a radian: rollers scrub
  double heading_rad2_per_m = 1e-4;    ///< 0.6 degrees after a metre
  double heading_rad2_per_rad = 1e-3;  ///< 1.8 degrees after a radian
};

/// A pose that something else measured: a scan matched to the map, a camera, a person's tap.
struct ExternalPose {
  Pose pose;
  PoseCovariance covariance = PoseCovariance::Zero();
  Instant at{};  ///< when it was so, on the loop's clock; not when it arrived
};
[[nodiscard]] PoseCovariance covariance_of(double sigma_x_m, double sigma_y_m, double sigma_heading_rad) noexcept;

/// Why a step or a pose was not taken, in the order of the checks.
enum class PoseRefusal : std::uint8_t {
  kNone,
  kNotStarted,  ///< before reset()
  kNotFinite,   ///< a pose, covariance or step with a number that is none
  kCovariance,  ///< not symmetric and positive definite, or so large or small that nothing can be computed with it
  kFromFuture,  ///< measured after the last step
  kTooOld,      ///< measured more than kHorizon before it, or before the oldest step that is kept
  kTooFar,      ///< a jump: beyond the gate by Mahalanobis distance
  kTooMany,     ///< more than kPoses within kHorizon
  kBackInTime,  ///< a step that is not later than the one before
};
inline constexpr int kPoseRefusals = 9;

[[nodiscard]] std::string_view name_of(PoseRefusal refusal) noexcept;

/// Each cycle: predict; then correct with what has arrived. A pose that comes late is taken where it belongs: the
/// filter goes back to its time, corrects, and lays the steps and poses since over it again, so the order of arrival
/// does not matter. One thread. No heap; about 80 KB. Sources: the propagation of Thrun, Burgard, Fox, Probabilistic
/// Robotics, 3.3; Joseph's form of the update, Bar-Shalom, Li, Kirubarajan, Estimation with Applications, 5.2.
class PoseFilter {
 public:
  static constexpr Duration kHorizon = std::chrono::milliseconds(500);
  static constexpr std::size_t kSteps = 512;  ///< kHorizon at 1 kHz, and some jitter
  static constexpr std::size_t kPoses = 64;   ///< within kHorizon: 128 a second
  /// Chi-square with three degrees of freedom: one true pose in a thousand is refused.
  static constexpr double kGate = 16.266;

  explicit PoseFilter(const OdometryNoise& noise = {}) noexcept : noise_(noise) {}

  /// Begins anew: at `pose` with `covariance`, which may be 0 in part. Refuses as kNotFinite and kCovariance, and then
  /// goes on as before.
  [[nodiscard]] PoseRefusal reset(const Pose& pose, const PoseCovariance& covariance, Instant now) noexcept;

  /// One step of odometry: the body-frame displacement since the last one (Odometry::moved), which ended `now`.
  PoseRefusal predict(const Twist& moved, Instant now) noexcept;

  /// Cost: up to kSteps steps again, some 0.1 ms for a pose that is kHorizon old.
  PoseRefusal correct(const ExternalPose& measured) noexcept;

  /// At the last step; the heading within [-pi, pi].
  [[nodiscard]] const Pose& pose() const noexcept { return newest().belief.pose; }
  [[nodiscard]] const PoseCovariance& covariance() const noexcept { return newest().belief.covariance; }
  [[nodiscard]] Instant at() const noexcept { return newest().at; }

  [[nodiscard]] std::uint64_t accepted() const noexcept { return accepted_; }
  [[nodiscard]] std::uint64_t refused(PoseRefusal reason) const noexcept;
  /// Poses in a row that lay beyond the gate: many of them mean that the filter is what is wrong. What to do then is
  /// the caller's to decide; reset() is how.
  [[nodiscard]] std::uint64_t jumps_in_a_row() const noexcept { return jumps_in_a_row_; }
  /// Squared Mahalanobis distance of the last pose that came to the gate.
  [[nodiscard]] double last_distance2() const noexcept { return last_distance2_; }

 private:
  struct Belief {
    Pose pose;
    PoseCovariance covariance = PoseCovariance::Zero();
  };
  struct Correction {
    Belief after;
    double distance2 = 0.0;  // squared Mahalanobis distance of what was measured from what was believed
  };
  struct Step {
    Instant at{};
    Twist moved;    // since the step before
    Belief belief;  // after it
  };

  [[nodiscard]] const Step& step(std::size_t n) const noexcept { return steps_[(first_ + n) % kSteps]; }
  [[nodiscard]] Step& step(std::size_t n) noexcept { return steps_[(first_ + n) % kSteps]; }
  [[nodiscard]] const Step& newest() const noexcept { return step(kept_ > 0 ? kept_ - 1 : 0); }

  PoseRefusal take(const ExternalPose& measured) noexcept;
  [[nodiscard]] Belief moved_by(const Belief& from, const Twist& moved) const noexcept;
  [[nodiscard]] static Correction corrected(const Belief& before, const ExternalPose& measured) noexcept;
  [[nodiscard]] Belief within_step(std::size_t n, Instant until) const noexcept;
  void keep(const ExternalPose& measured) noexcept;
  void forget_oldest_step() noexcept;
  void forget_poses_of_the_past() noexcept;
  PoseRefusal count(PoseRefusal refusal) noexcept;

  OdometryNoise noise_;
  std::array<Step, kSteps> steps_{};  // a ring from first_; the first kept one is only where others begin
  std::size_t first_ = 0;
  std::size_t kept_ = 0;
  std::array<ExternalPose, kPoses> poses_{};  // accepted, by time
  std::size_t poses_kept_ = 0;
  std::uint64_t accepted_ = 0;
  std::array<std::uint64_t, kPoseRefusals> refused_{};
  std::uint64_t jumps_in_a_row_ = 0;
  double last_distance2_ = 0.0;
};

}  // namespace ivo::firmware
