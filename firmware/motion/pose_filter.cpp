#include "firmware/motion/pose_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/motion/arc.hpp"
#include "firmware/motion/finite.hpp"

namespace ivo::firmware {
namespace {

constexpr std::array<std::string_view, kPoseRefusals> kNames{
    "none",    "not started", "not finite",   "covariance not positive definite", "from the future", "too old",
    "too far", "too many",    "back in time",
};

double wrapped(double angle_rad) noexcept { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

// What a matrix that was computed as symmetric may be off by.
constexpr double kRounding = 1e-9;

bool symmetric(const PoseCovariance& m) noexcept {
  return (m - m.transpose()).cwiseAbs().maxCoeff() <= kRounding * m.cwiseAbs().maxCoeff();
}

PoseCovariance symmetrised(const PoseCovariance& m) noexcept { return 0.5 * (m + m.transpose()); }

bool positive_definite(const PoseCovariance& m) noexcept { return m.llt().info() == Eigen::Success; }

PoseRefusal judge(const Pose& pose, const PoseCovariance& covariance, bool may_be_singular) noexcept {
  if (!finite(pose) || !covariance.allFinite()) {
    return PoseRefusal::kNotFinite;
  }
  const PoseCovariance padded =
      may_be_singular ? PoseCovariance(covariance + kRounding * PoseCovariance::Identity()) : covariance;
  return symmetric(covariance) && positive_definite(padded) ? PoseRefusal::kNone : PoseRefusal::kCovariance;
}

Twist part_of(const Twist& moved, double part) noexcept {
  return {part * moved.vx_mps, part * moved.vy_mps, part * moved.wz_radps};
}

}  // namespace

std::string_view name_of(PoseRefusal refusal) noexcept { return kNames[static_cast<std::size_t>(refusal)]; }

PoseCovariance covariance_of(double sigma_x_m, double sigma_y_m, double sigma_heading_rad) noexcept {
  return Eigen::Vector3d(sigma_x_m * sigma_x_m, sigma_y_m * sigma_y_m, sigma_heading_rad * sigma_heading_rad)
      .asDiagonal();
}

std::uint64_t PoseFilter::refused(PoseRefusal reason) const noexcept {
  return refused_[static_cast<std::size_t>(reason)];
}

PoseRefusal PoseFilter::count(PoseRefusal refusal) noexcept {
  if (refusal != PoseRefusal::kNone) {
    ++refused_[static_cast<std::size_t>(refusal)];
  }
  return refusal;
}

PoseRefusal PoseFilter::reset(const Pose& pose, const PoseCovariance& covariance, Instant now) noexcept {
  const PoseRefusal refusal = judge(pose, covariance, true);
  if (refusal == PoseRefusal::kNone) {
    first_ = 0;
    kept_ = 1;
    steps_[0] = {now, {}, {{pose.x_m, pose.y_m, wrapped(pose.heading_rad)}, symmetrised(covariance)}};
    poses_kept_ = 0;
    jumps_in_a_row_ = 0;
  }
  return count(refusal);
}

PoseRefusal PoseFilter::predict(const Twist& moved, Instant now) noexcept {
  if (kept_ == 0) {
    return count(PoseRefusal::kNotStarted);
  }
  if (!finite(moved)) {
    return count(PoseRefusal::kNotFinite);
  }
  if (now <= at()) {
    return count(PoseRefusal::kBackInTime);
  }
  const Belief after = moved_by(newest().belief, moved);
  if (!finite(after.pose) || !after.covariance.allFinite()) {
    return count(PoseRefusal::kNotFinite);
  }
  if (kept_ == kSteps) {
    forget_oldest_step();
  }
  step(kept_++) = {now, moved, after};
  while (kept_ > 2 && step(1).at <= now - kHorizon) {
    forget_oldest_step();
  }
  forget_poses_of_the_past();
  return PoseRefusal::kNone;
}

void PoseFilter::forget_oldest_step() noexcept {
  first_ = (first_ + 1) % kSteps;
  --kept_;
}

// Of the first step kept only the end counts, and these poses are in it.
void PoseFilter::forget_poses_of_the_past() noexcept {
  std::size_t gone = 0;
  while (gone < poses_kept_ && poses_[gone].at <= step(0).at) {
    ++gone;
  }
  if (gone > 0) {
    std::copy(poses_.begin() + static_cast<std::ptrdiff_t>(gone),
              poses_.begin() + static_cast<std::ptrdiff_t>(poses_kept_), poses_.begin());
    poses_kept_ -= gone;
  }
}

PoseRefusal PoseFilter::correct(const ExternalPose& measured) noexcept {
  if (kept_ == 0) {
    return count(PoseRefusal::kNotStarted);
  }
  const PoseRefusal refusal = judge(measured.pose, measured.covariance, false);
  return count(refusal == PoseRefusal::kNone ? take(measured) : refusal);
}

PoseRefusal PoseFilter::take(const ExternalPose& measured) noexcept {
  if (measured.at > at()) {
    return PoseRefusal::kFromFuture;
  }
  if (measured.at < at() - kHorizon || measured.at < step(0).at) {
    return PoseRefusal::kTooOld;
  }
  if (poses_kept_ == kPoses) {
    return PoseRefusal::kTooMany;
  }
  std::size_t n = kept_ - 1;  // the step in which it was measured
  while (n > 0 && step(n - 1).at >= measured.at) {
    --n;
  }
  const Correction correction = corrected(within_step(n, measured.at), measured);
  // Of a covariance at the end of what doubles can hold nothing comes out.
  if (!std::isfinite(correction.distance2) || !finite(correction.after.pose) ||
      !correction.after.covariance.allFinite()) {
    return PoseRefusal::kCovariance;
  }
  last_distance2_ = correction.distance2;
  if (correction.distance2 > kGate) {
    ++jumps_in_a_row_;
    return PoseRefusal::kTooFar;
  }
  jumps_in_a_row_ = 0;
  keep(measured);
  if (n == 0) {
    step(0).belief = correction.after;  // exactly at the first step kept, which is never done again
  }
  for (std::size_t again = std::max<std::size_t>(n, 1); again < kept_; ++again) {
    step(again).belief = within_step(again, step(again).at);
  }
  ++accepted_;
  return PoseRefusal::kNone;
}

PoseFilter::Belief PoseFilter::moved_by(const Belief& from, const Twist& moved) const noexcept {
  const double way_m = std::hypot(moved.vx_mps, moved.vy_mps);
  const double turn_rad = std::abs(moved.wz_radps);
  const double position_m2 = noise_.position_m2_per_m * way_m + noise_.position_m2_per_rad * turn_rad;
  const double heading_rad2 = noise_.heading_rad2_per_m * way_m + noise_.heading_rad2_per_rad * turn_rad;
  Belief to;
  to.pose = advance(from.pose, moved, 1.0);
  const double dx_m = to.pose.x_m - from.pose.x_m;
  const double dy_m = to.pose.y_m - from.pose.y_m;
  // A heading that is off turns the whole step; one that goes off on the way turns half of it.
  PoseCovariance before = PoseCovariance::Identity();
  before(0, 2) = -dy_m;
  before(1, 2) = dx_m;
  PoseCovariance during = PoseCovariance::Identity();
  during(0, 2) = -0.5 * dy_m;
  during(1, 2) = 0.5 * dx_m;
  const PoseCovariance noise = Eigen::Vector3d(position_m2, position_m2, heading_rad2).asDiagonal();
  to.covariance = symmetrised(before * from.covariance * before.transpose() + during * noise * during.transpose());
  return to;
}

// Step n from its beginning until `until`, with the poses that were accepted on the way.
PoseFilter::Belief PoseFilter::within_step(std::size_t n, Instant until) const noexcept {
  if (n == 0) {
    return step(0).belief;
  }
  const Step& whole = step(n);
  const Instant begin = step(n - 1).at;
  const double whole_s = seconds(whole.at - begin);
  Belief belief = step(n - 1).belief;
  Instant reached = begin;
  const auto go_to = [&](Instant to) noexcept {
    if (to > reached) {
      belief = moved_by(belief, part_of(whole.moved, seconds(to - reached) / whole_s));
      reached = to;
    }
  };
  for (std::size_t i = 0; i < poses_kept_; ++i) {
    const ExternalPose& pose = poses_[i];
    if (pose.at > begin && pose.at <= until) {
      go_to(pose.at);
      belief = corrected(belief, pose).after;
    }
  }
  go_to(until);
  return belief;
}

// What is measured is the state itself. K = P S^-1; Joseph's form keeps the covariance positive whatever K rounds to.
PoseFilter::Correction PoseFilter::corrected(const Belief& before, const ExternalPose& measured) noexcept {
  const PoseCovariance noise = symmetrised(measured.covariance);
  const Eigen::Vector3d off(measured.pose.x_m - before.pose.x_m, measured.pose.y_m - before.pose.y_m,
                            wrapped(measured.pose.heading_rad - before.pose.heading_rad));
  const Eigen::LLT<PoseCovariance> spread(before.covariance + noise);
  // S and P are symmetric, so K is the transpose of S^-1 P.
  // Column by column: for a matrix Eigen has code that can take memory.
  PoseCovariance gain;
  for (Eigen::Index i = 0; i < gain.rows(); ++i) {
    gain.row(i) = spread.solve(Eigen::Vector3d(before.covariance.col(i))).transpose();
  }
  const Eigen::Vector3d change = gain * off;
  const PoseCovariance kept = PoseCovariance::Identity() - gain;
  return {{{before.pose.x_m + change[0], before.pose.y_m + change[1], wrapped(before.pose.heading_rad + change[2])},
           symmetrised(kept * before.covariance * kept.transpose() + gain * noise * gain.transpose())},
          off.dot(spread.solve(off))};
}

void PoseFilter::keep(const ExternalPose& measured) noexcept {
  std::size_t place = poses_kept_++;
  for (; place > 0 && poses_[place - 1].at > measured.at; --place) {
    poses_[place] = poses_[place - 1];
  }
  poses_[place] = measured;
}

}  // namespace ivo::firmware
