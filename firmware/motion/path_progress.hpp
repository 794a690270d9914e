// Where a robot stands along a polyline. Forward only: what is passed stays passed.
#pragma once

#include <cstddef>
#include <span>

#include "config/base/geometry.hpp"
#include "firmware/motion/vector2.hpp"

namespace ivo::firmware {

/// One straight piece of a path. A piece between points closer than a micrometre has length 0 and no direction of its
/// own.
struct Leg {
  Vector2 from;
  Vector2 direction{1.0, 0.0};
  double length_m = 0.0;
};

class PathProgress {
 public:
  /// Legs passed, or looked ahead at, in one cycle.
  static constexpr std::size_t kLegsPerCycle = 32;
  /// A robot this near to the first leg joins it there; from further away it is led to the path's first point.
  static constexpr double kJoin_m = 0.05;

  /// Takes up `path`, which stays the caller's and must outlive its use here, for a robot at `from`. False, and no
  /// path, when it is empty or a coordinate is not finite. Cost: one pass over the points.
  [[nodiscard]] bool start(std::span<const Point> path, const Point& from) noexcept;

  /// The same for a robot that had `left_m` of the path before it when it was last on it: what lies before that is
  /// passed, also where the path crosses itself. More than the path is long: from its beginning, as start(). False, and
  /// no path, as there, and when `left_m` is not finite.
  [[nodiscard]] bool resume(std::span<const Point> path, const Point& at, double left_m) noexcept;

  /// The robot is at `at` (finite). Only with a path. Cost: at most kLegsPerCycle legs.
  void update(const Point& at) noexcept;

  [[nodiscard]] bool has_path() const noexcept { return !path_.empty(); }
  [[nodiscard]] const Leg& leg() const noexcept { return leg_; }
  [[nodiscard]] std::size_t leg_index() const noexcept { return index_; }
  [[nodiscard]] std::size_t last_leg_index() const noexcept { return last_index_; }
  [[nodiscard]] bool on_last_leg() const noexcept { return index_ == last_index_; }
  /// Leg `index`, at most last_leg_index(). Leg 0 leads the robot from where it stood to the path's first point.
  [[nodiscard]] Leg leg_at(std::size_t index) const noexcept;

  /// From the robot's foot point to the end of the leg; negative beyond it.
  [[nodiscard]] double along_left_m() const noexcept { return leg_.length_m - along_m_; }
  /// What is left of the leg; never grows on one leg.
  [[nodiscard]] double leg_left_m() const noexcept { return leg_.length_m - passed_m_; }
  /// What is left of the path; never grows.
  [[nodiscard]] double distance_left_m() const noexcept { return leg_left_m() + beyond_m_; }
  /// From the line of the leg to the robot, positive to the left of it.
  [[nodiscard]] double cross_track_m() const noexcept { return cross_track_m_; }
  /// Straight from the robot to the path's end.
  [[nodiscard]] double to_end_m() const noexcept { return to_end_m_; }

 private:
  [[nodiscard]] const Point& vertex(std::size_t index) const noexcept { return index == 0 ? lead_ : path_[index - 1]; }
  void enter(std::size_t index) noexcept;

  std::span<const Point> path_;
  Point lead_;
  std::size_t index_ = 0;
  std::size_t last_index_ = 0;
  Leg leg_;
  double along_m_ = 0.0;
  double passed_m_ = 0.0;
  double beyond_m_ = 0.0;
  double cross_track_m_ = 0.0;
  double to_end_m_ = 0.0;
};

}  // namespace ivo::firmware
