// A path that is gone on with: from where it was left, not from its beginning, and not from where it crosses itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "firmware/motion/arc.hpp"
#include "firmware/motion/path_follower.hpp"

namespace ivo::firmware {
namespace {

using Path = std::vector<Point>;
constexpr Duration kResumedCycle = std::chrono::milliseconds(2);

double planned_length_of(const Path& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    sum += std::hypot(path[i].x_m - path[i - 1].x_m, path[i].y_m - path[i - 1].y_m);
  }
  return sum;
}

Path random_path(std::mt19937& random) {
  std::uniform_real_distribution<double> place(0.0, 20.0);
  Path path(12);
  for (Point& point : path) {
    point = {place(random), place(random)};
  }
  path[5] = path[4];  // a leg without a length
  return path;
}

TEST(PathResume, AtAnyPlaceOfAnyPathAsMuchIsLeftAsWasLeft) {
  std::mt19937 random(11);
  for (int n = 0; n < 50; ++n) {
    const Path path = random_path(random);
    double behind_m = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      for (double t = 0.0; t < 1.0; t += 0.13) {
        const Point at{path[i - 1].x_m + t * (path[i].x_m - path[i - 1].x_m),
                       path[i - 1].y_m + t * (path[i].y_m - path[i - 1].y_m)};
        const double left_m = planned_length_of(path) - behind_m - t * planned_length_of({path[i - 1], path[i]});
        PathProgress resumed;
        ASSERT_TRUE(resumed.resume(path, at, left_m));
        ASSERT_NEAR(resumed.distance_left_m(), left_m, 1e-9) << n << " " << i << " " << t;
      }
      behind_m += planned_length_of({path[i - 1], path[i]});
    }
  }
}

TEST(PathResume, WherePathsCrossTheOneThatWasLeftIsGoneOnWith) {
  const Path eight = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, -2}};
  const Point crossing{2, 0};
  PathProgress first;
  ASSERT_TRUE(first.resume(eight, crossing, planned_length_of(eight) - 2.0));
  EXPECT_DOUBLE_EQ(first.distance_left_m(), planned_length_of(eight) - 2.0);
  EXPECT_EQ(first.leg_index(), 1U);
  PathProgress second;
  ASSERT_TRUE(second.resume(eight, crossing, 2.0));
  EXPECT_EQ(second.leg_index(), 4U);
  EXPECT_DOUBLE_EQ(second.distance_left_m(), 2.0);
}

TEST(PathResume, WithMoreLeftThanThePathIsLongItBegins) {
  const Path path = {{1, 0}, {3, 0}};
  PathProgress progress;
  ASSERT_TRUE(progress.resume(path, {0, 0}, 2.5));
  EXPECT_EQ(progress.leg_index(), 0U);
  EXPECT_DOUBLE_EQ(progress.distance_left_m(), 3.0);
}

TEST(PathResume, RefusesWhatIsNoNumberAndNoPath) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Path path = {{0, 0}, {1, 0}};
  PathProgress progress;
  EXPECT_FALSE(progress.resume(path, {0, 0}, nan));
  EXPECT_FALSE(progress.resume(path, {nan, 0}, 0.5));
  EXPECT_FALSE(progress.resume({}, {0, 0}, 0.5));
  EXPECT_FALSE(progress.has_path());
  PathFollower follower({});
  EXPECT_FALSE(follower.resume(path, {0, 0, 0}, nan, 0.5));
  EXPECT_EQ(follower.update({.pose = {}, .moving = {}, .dt = kResumedCycle}).command.vx_mps, 0.0);
}

TEST(PathResume, ARobotGoesOnFromWhereItStandsAndTakesUpItsOldHeading) {
  const Path path = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  PathFollower follower({});
  Pose pose{1.2, 0.06, 0.1};  // a little off the path, turned
  ASSERT_TRUE(follower.resume(path, pose, 0.0, planned_length_of(path) - 1.2));
  Twist moving;
  PathFollower::Output out;
  double least_x = pose.x_m;
  for (int n = 0; n < 20000 && !out.reached; ++n) {
    out = follower.update({.pose = pose, .moving = moving, .dt = kResumedCycle});
    moving = out.command;
    pose = advance(pose, moving, seconds(kResumedCycle));
    if (pose.y_m < 0.5) {
      least_x = std::min(least_x, pose.x_m);
    }
  }
  EXPECT_TRUE(out.reached);
  EXPECT_GT(least_x, 1.15);
  EXPECT_NEAR(pose.heading_rad, 0.0, 0.01);
}

TEST(PathResume, APathThatWasAtItsEndIsReached) {
  const Path path = {{0, 0}, {2, 0}};
  PathFollower follower({});
  ASSERT_TRUE(follower.resume(path, {1.99, 0, 0}, 0.0, 0.0));
  EXPECT_TRUE(follower.update({.pose = {1.99, 0, 0}, .moving = {}, .dt = kResumedCycle}).reached);
}

}  // namespace
}  // namespace ivo::firmware
