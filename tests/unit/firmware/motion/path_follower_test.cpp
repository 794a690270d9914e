#include "firmware/motion/path_follower.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "firmware/motion/arc.hpp"
#include "firmware/motion/limiter.hpp"
#include "firmware/motion/odometry.hpp"

namespace ivo::firmware {
namespace {

using std::numbers::pi;
constexpr Duration kPeriod = std::chrono::milliseconds(2);
using Path = std::vector<Point>;

double distance(Point a, Point b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

double length_of(const Path& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    sum += distance(path[i - 1], path[i]);
  }
  return sum;
}

/// Whether a drive keeps within `tolerance_m` of a path and passes all of it in order: the Frechet distance, decided on
/// points of the path 5 mm apart. A short cut fails it even where the path comes near to itself.
class Tube {
 public:
  Tube(const Path& path, double tolerance_m) : tolerance_m_(tolerance_m) {
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Point a = path[i - 1];
      const Point b = path[i];
      const int steps = std::max(1, static_cast<int>(std::ceil(distance(a, b) / 0.005)));
      for (int n = 0; n < steps; ++n) {
        const double t = static_cast<double>(n) / steps;
        points_.push_back({a.x_m + t * (b.x_m - a.x_m), a.y_m + t * (b.y_m - a.y_m)});
      }
    }
    points_.push_back(path.back());
    reached_.assign(points_.size(), false);
    reached_[0] = true;
  }
  void pass(Point at) {
    bool before_old = false;
    bool before_new = false;
    std::size_t first = points_.size();
    std::size_t end = 0;
    for (std::size_t i = first_; i < points_.size() && (i <= end_ || before_new); ++i) {
      const bool old = reached_[i];
      before_new = (old || before_old || before_new) && distance(at, points_[i]) < tolerance_m_;
      before_old = old;
      reached_[i] = before_new;
      if (before_new) {
        first = std::min(first, i);
        end = i + 1;
      }
    }
    first_ = first;
    end_ = end;
  }
  bool kept() const { return reached_.back(); }

 private:
  double tolerance_m_;
  Path points_;
  std::vector<bool> reached_;  // by a drive so far, at each point; true only within [first_, end_)
  std::size_t first_ = 0;
  std::size_t end_ = 1;
};

struct Drive {
  bool started = false;
  bool reached = false;
  double duration_s = 0;
  bool kept_to_path = false;
  double end_error_m = 0;  ///< after it has come to rest
  double worst_heading_rad = 0;
  bool distance_grew = false;
  bool limiter_acted = false;
};

/// A base that moves as told, at 500 Hz, behind a limiter.
class PerfectBase {
 public:
  explicit PerfectBase(Pose pose = {}, MotionLimits limits = {}) : pose_(pose), limits_(limits) {}

  Drive follow(const Path& path, double tolerance_m = 0.10) {
    Drive run;
    PathFollower follower(limits_);
    Limiter limiter(limits_);
    const double heading_rad = pose_.heading_rad;
    run.started = follower.start(path, pose_);
    if (!run.started) {
      return run;
    }
    const double patience_s = 60 + 20 * (length_of(path) + distance(pose_.point(), path.front()));
    double left_m = std::numeric_limits<double>::infinity();
    Tube tube(path, tolerance_m);
    while (!run.reached && run.duration_s < patience_s) {
      const PathFollower::Output out = follower.update({pose_, limiter.current(), kPeriod});
      const Twist sent = limiter.limit(out.command, kPeriod);
      run.limiter_acted =
          run.limiter_acted || distance({sent.vx_mps, sent.vy_mps}, {out.command.vx_mps, out.command.vy_mps}) > 1e-12;
      run.distance_grew = run.distance_grew || out.distance_left_m > left_m + 1e-9;
      left_m = out.distance_left_m;
      run.reached = out.reached;
      pose_ = advance(pose_, sent, seconds(kPeriod));
      run.duration_s += seconds(kPeriod);
      tube.pass(pose_.point());
      run.worst_heading_rad =
          std::max(run.worst_heading_rad, std::abs(std::remainder(pose_.heading_rad - heading_rad, 2 * pi)));
    }
    while (limiter.current().vx_mps != 0 || limiter.current().vy_mps != 0) {
      pose_ = advance(pose_, limiter.limit(follower.update({pose_, limiter.current(), kPeriod}).command, kPeriod),
                      seconds(kPeriod));
    }
    run.kept_to_path = tube.kept();
    run.end_error_m = distance(pose_.point(), path.back());
    return run;
  }
  const Pose& pose() const { return pose_; }

 private:
  Pose pose_;
  MotionLimits limits_;
};

Path random_path(std::mt19937_64& random, int points, double shortest_m, double longest_m, double sharpest_rad) {
  std::uniform_real_distribution<double> length(std::log(shortest_m), std::log(longest_m));
  std::uniform_real_distribution<double> turn(-sharpest_rad, sharpest_rad);
  Path path{{20.0, 20.0}};
  double heading = turn(random);
  for (int i = 1; i < points; ++i) {
    const double l = std::exp(length(random));
    path.push_back({path.back().x_m + l * std::cos(heading), path.back().y_m + l * std::sin(heading)});
    heading += turn(random);
  }
  return path;
}

TEST(PathFollower, StaysWithinTenCentimetresOfAnyPolyline) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    const Path path = random_path(random, 25, 0.2, seed % 2 == 0 ? 10.0 : 0.6, pi);
    std::uniform_real_distribution<double> heading(-pi, pi);
    const Drive run = PerfectBase({20.0, 20.0, heading(random)}).follow(path);
    ASSERT_TRUE(run.reached) << "seed " << seed;
    ASSERT_TRUE(run.kept_to_path) << "seed " << seed;
    ASSERT_LT(run.end_error_m, PathFollower::kEndTolerance_m) << "seed " << seed;
    ASSERT_FALSE(run.distance_grew) << "seed " << seed;
    ASSERT_FALSE(run.limiter_acted) << "seed " << seed;
    ASSERT_LT(run.worst_heading_rad, 1e-6) << "seed " << seed;
  }
}

TEST(PathFollower, TakesLittleLongerThanLengthOverSpeedOnGentlePaths) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    const Path path = random_path(random, 15, 2.0, 6.0, pi / 6);
    const Drive run = PerfectBase({20.0, 20.0, 0.0}).follow(path);
    ASSERT_TRUE(run.reached) << "seed " << seed;
    const double ideal_s = length_of(path) / MotionLimits{}.max_speed_mps;
    ASSERT_GT(run.duration_s, ideal_s * 0.99) << "seed " << seed;
    ASSERT_LT(run.duration_s, ideal_s * 1.25) << "seed " << seed;
  }
}

// The fast profile's plan of the courtyard: waypoints off the graph, short legs and sharp turns.
TEST(PathFollower, FollowsAnImprovedPlanAtThePaceItAssumes) {
  const Path plan{{10.5, 10.0},     {9.703, 9.219},   {9.453, 9.453},   {14.422, 14.078}, {12.25, 11.984},
                  {13.859, 11.984}, {15.906, 14.766}, {12.766, 16.547}, {7.563, 17.797},  {8.564, 13.517},
                  {10.688, 10.688}, {11.922, 6.578},  {12.969, 5.719},  {7.984, 4.844},   {12.144, 8.789}};
  const double assumed_mps = 0.35;
  const Drive run = PerfectBase({10.5, 10.0, pi / 2}).follow(plan);
  EXPECT_TRUE(run.reached);
  EXPECT_TRUE(run.kept_to_path);
  EXPECT_LT(run.end_error_m, PathFollower::kEndTolerance_m);
  EXPECT_LT(run.duration_s, 1.1 * length_of(plan) / assumed_mps);
}

TEST(PathFollower, SlowsDownForACurveOfManySmallCorners) {
  Path path;
  for (int i = 0; i <= 63; ++i) {
    path.push_back({0.2 * std::sin(i * 0.1), 0.2 - 0.2 * std::cos(i * 0.1)});
  }
  const Drive run = PerfectBase().follow(path, 0.02);
  EXPECT_TRUE(run.reached);
  EXPECT_TRUE(run.kept_to_path);
}

TEST(PathFollower, FollowsAPathOfThousandsOfPointsAMillimetreApart) {
  Path path;
  for (int i = 0; i <= 3000; ++i) {
    path.push_back({i * 0.001, 0.0});
  }
  const Drive run = PerfectBase().follow(path, 0.03);
  EXPECT_TRUE(run.reached);
  EXPECT_TRUE(run.kept_to_path);
}

TEST(PathFollower, CrawlsButDoesNotStopAtEveryJagOfARaggedPath) {
  Path path;
  for (int i = 0; i <= 1000; ++i) {
    path.push_back({i * 0.001, (i % 2) * 0.001});
  }
  const Drive run = PerfectBase().follow(path);
  EXPECT_TRUE(run.reached);
  EXPECT_TRUE(run.kept_to_path);
  EXPECT_LT(run.duration_s, 40.0) << "1.4 m at 0.06 m/s";
}

TEST(PathFollower, TurnsBackOnItself) {
  const Drive run = PerfectBase().follow({{0, 0}, {2, 0}, {0, 0}}, 0.06);
  EXPECT_TRUE(run.reached);
  EXPECT_TRUE(run.kept_to_path);
  EXPECT_GT(run.duration_s, 8.0);
}

TEST(PathFollower, DrivesAClosedPathAllTheWayRound) {
  const Drive run = PerfectBase().follow({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}});
  EXPECT_TRUE(run.reached);
  EXPECT_GT(run.duration_s, 16.0);
}

TEST(PathFollower, KeepsToThePathWithAnyBaseThatARobotFileMayDescribe) {
  for (const double speed_mps : {0.1, 0.5, 1.0, 2.0}) {
    for (const double accel_mps2 : {0.05, 0.5, 10.0}) {
      MotionLimits limits;
      limits.max_speed_mps = speed_mps;
      limits.max_accel_mps2 = accel_mps2;
      std::mt19937_64 random(5);
      const Drive run = PerfectBase({20, 20, 1.0}, limits).follow(random_path(random, 20, 0.2, 3.0, pi));
      EXPECT_TRUE(run.reached) << speed_mps << " m/s, " << accel_mps2 << " m/s^2";
      EXPECT_TRUE(run.kept_to_path) << speed_mps << " m/s, " << accel_mps2 << " m/s^2";
      EXPECT_FALSE(run.limiter_acted) << speed_mps << " m/s, " << accel_mps2 << " m/s^2";
    }
  }
}

TEST(PathFollower, GoesToThePathFirstWhenItStandsOffIt) {
  PerfectBase base({-1.0, 1.0, 0.5});
  const Drive run = base.follow({{0, 0}, {3, 0}});
  EXPECT_TRUE(run.reached);
  EXPECT_LT(run.end_error_m, PathFollower::kEndTolerance_m);
}

TEST(PathFollower, JoinsTheFirstSegmentWhereItStandsOnIt) {
  const Drive run = PerfectBase({1.0, 0.03, 0.0}).follow({{0, 0}, {3, 0}});
  EXPECT_TRUE(run.reached);
  EXPECT_LT(run.duration_s, 6.5) << "2 m at 0.5 m/s, not 4";
}

TEST(PathFollower, RefusesAnEmptyPath) {
  PathFollower follower{MotionLimits{}};
  EXPECT_FALSE(follower.start({}, {}));
  const PathFollower::Output out = follower.update({{}, {0.3, 0, 0}, kPeriod});
  EXPECT_EQ(out.command.vx_mps, 0.0);
  EXPECT_FALSE(out.reached);
}

TEST(PathFollower, RefusesPointsAndPosesThatAreNotNumbers) {
  const double nan = std::nan("");
  const double inf = std::numeric_limits<double>::infinity();
  PathFollower follower{MotionLimits{}};
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_FALSE(follower.start(Path{{0, 0}, {1, bad}, {2, 0}}, {}));
    EXPECT_FALSE(follower.start(Path{{bad, 0}}, {}));
    EXPECT_FALSE(follower.start(Path{{0, 0}, {1, 0}}, {0, bad, 0}));
    EXPECT_FALSE(follower.start(Path{{0, 0}, {1, 0}}, {0, 0, bad}));
  }
}

TEST(PathFollower, RefusesAPathLongerThanANumberCanSay) {
  PathFollower follower{MotionLimits{}};
  EXPECT_FALSE(follower.start(Path{{-1e308, 0}, {1e308, 0}}, {}));
}

TEST(PathFollower, ForgetsTheOldPathWhenTheNewOneIsRefused) {
  PathFollower follower{MotionLimits{}};
  const Path path{{0, 0}, {1, 0}};
  ASSERT_TRUE(follower.start(path, {}));
  ASSERT_GT(follower.update({{}, {}, kPeriod}).command.vx_mps, 0.0);
  ASSERT_FALSE(follower.start({}, {}));
  EXPECT_EQ(follower.update({{}, {}, kPeriod}).command.vx_mps, 0.0);
}

TEST(PathFollower, HasReachedASinglePointItStandsOn) {
  const Path path{{1, 1}};
  PathFollower follower{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, {1, 1, 0}));
  EXPECT_TRUE(follower.update({{1, 1, 0}, {}, kPeriod}).reached);
}

TEST(PathFollower, DrivesToASinglePoint) {
  const Drive run = PerfectBase({0, 0, 2.0}).follow({{1, 1}});
  EXPECT_TRUE(run.reached);
  EXPECT_LT(run.end_error_m, PathFollower::kEndTolerance_m);
}

TEST(PathFollower, CountsRepeatedPointsOnce) {
  Path path{{0, 0}, {0, 0}, {1, 0}};
  path.insert(path.end(), 1000, {1, 1});
  path.insert(path.end(), 1000, {2, 1});
  const Drive run = PerfectBase().follow(path);
  EXPECT_TRUE(run.reached);
  EXPECT_TRUE(run.kept_to_path);
  EXPECT_FALSE(run.limiter_acted);
  EXPECT_LT(run.end_error_m, PathFollower::kEndTolerance_m);
}

TEST(PathFollower, TakesPointsThatAllRepeatForOne) {
  const Drive run = PerfectBase({0, 1, 0}).follow(Path(500, Point{1, 1}));
  EXPECT_TRUE(run.reached);
  EXPECT_LT(run.end_error_m, PathFollower::kEndTolerance_m);
}

TEST(PathFollower, IsNotThereYetWhileItIsFast) {
  const Path path{{0, 0}, {1, 0}};
  PathFollower follower{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, {}));
  EXPECT_FALSE(follower.update({{0.99, 0, 0}, {0.4, 0, 0}, kPeriod}).reached);
  EXPECT_TRUE(follower.update({{0.99, 0, 0}, {0.05, 0, 0}, kPeriod}).reached);
}

TEST(PathFollower, StaysReachedUntilItIsStartedAgain) {
  const Path path{{0, 0}, {1, 0}};
  PathFollower follower{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, {}));
  ASSERT_TRUE(follower.update({{1, 0, 0}, {}, kPeriod}).reached);
  const PathFollower::Output pushed = follower.update({{0.5, 0, 0}, {}, kPeriod});
  EXPECT_TRUE(pushed.reached);
  EXPECT_EQ(pushed.command.vx_mps, 0.0);
  ASSERT_TRUE(follower.start(path, {0.5, 0, 0}));
  EXPECT_FALSE(follower.update({{0.5, 0, 0}, {}, kPeriod}).reached);
}

TEST(PathFollower, ComesBackWhenItIsCarriedPastTheEnd) {
  const Path path{{0, 0}, {1, 0}};
  PathFollower follower{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, {}));
  EXPECT_LT(follower.update({{1.3, 0, 0}, {}, kPeriod}).command.vx_mps, 0.0);
  EXPECT_GT(follower.update({{0.9, 0, 0}, {}, kPeriod}).command.vx_mps, 0.0) << "and when carried back again";
}

TEST(PathFollower, ReturnsToThePathBeforeItGoesOn) {
  const Path path{{0, 0}, {5, 0}};
  PathFollower follower{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, {}));
  const PathFollower::Output out = follower.update({{2, 0.3, 0}, {}, kPeriod});
  EXPECT_NEAR(out.cross_track_m, 0.3, 1e-12);
  EXPECT_EQ(out.command.vx_mps, 0.0);
  EXPECT_LT(out.command.vy_mps, 0.0);
  EXPECT_NEAR(follower.update({{2, -0.2, 0}, {}, kPeriod}).cross_track_m, -0.2, 1e-12);
}

TEST(PathFollower, NeverTakesBackProgress) {
  const Path path{{0, 0}, {5, 0}};
  PathFollower follower{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, {}));
  EXPECT_NEAR(follower.update({{2, 0, 0}, {}, kPeriod}).distance_left_m, 3.0, 1e-12);
  EXPECT_NEAR(follower.update({{1, 0, 0}, {}, kPeriod}).distance_left_m, 3.0, 1e-12);
}

TEST(PathFollower, TurnsBackToItsHeading) {
  const Path path{{0, 0}, {5, 0}};
  PathFollower follower{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, {0, 0, 3.1}));
  EXPECT_LT(follower.update({{0, 0, -3.1}, {}, kPeriod}).command.wz_radps, 0.0) << "the short way round";
  EXPECT_GT(follower.update({{0, 0, 3.0}, {}, kPeriod}).command.wz_radps, 0.0);
}

TEST(PathFollower, CommandsNothingFromAPoseThatIsNotANumber) {
  const Path path{{0, 0}, {5, 0}};
  PathFollower follower{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, {}));
  const PathFollower::Output out = follower.update({{std::nan(""), 0, 0}, {0.4, 0, 0}, kPeriod});
  EXPECT_EQ(out.command.vx_mps, 0.0);
  EXPECT_EQ(out.distance_left_m, 5.0);
  EXPECT_FALSE(out.reached);
  EXPECT_GT(follower.update({{0.1, 0, 0}, {0.4, 0, 0}, kPeriod}).command.vx_mps, 0.0) << "and goes on when it is";
}

TEST(PathFollower, BringsABaseThatMeasuresOnlyItsWheelsToTheEnd) {
  const Kinematics kinematics{BaseParameters{}};
  Odometry odometry(kinematics);
  odometry.reset({1, 1, 0.3});
  WheelValues angles_rad{};
  ASSERT_TRUE(odometry.update(angles_rad));
  const Path path{{1, 1}, {3, 1}, {3, 3}, {1, 2}};
  PathFollower follower{MotionLimits{}};
  Limiter limiter{MotionLimits{}};
  ASSERT_TRUE(follower.start(path, odometry.pose()));
  bool reached = false;
  for (int cycle = 0; cycle < 20'000 && !reached; ++cycle) {
    const PathFollower::Output out = follower.update({odometry.pose(), limiter.current(), kPeriod});
    const WheelValues speeds = kinematics.wheel_speeds(limiter.limit(out.command, kPeriod));
    for (std::size_t i = 0; i < kWheels; ++i) {
      angles_rad[i] += speeds[i] * seconds(kPeriod);
    }
    ASSERT_TRUE(odometry.update(angles_rad));
    reached = out.reached;
  }
  EXPECT_TRUE(reached);
  EXPECT_LT(distance(odometry.pose().point(), {1, 2}), PathFollower::kEndTolerance_m);
}

}  // namespace
}  // namespace ivo::firmware
