// Nothing here allocates, in any call of a cycle. What this says beyond "it runs" it says in the preset noheap.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdlib>

#include "config/rates.hpp"
#include "firmware/motion/kinematics.hpp"
#include "firmware/motion/limiter.hpp"
#include "firmware/motion/odometry.hpp"
#include "firmware/motion/path_follower.hpp"
#include "firmware/motion/pose_filter.hpp"
#include "firmware/motion/slip_monitor.hpp"
#include "tests/support/heap_trap.hpp"

namespace ivo::firmware {
namespace {

TEST(Motion, DrivesAPathWithPosesFromOutsideAndNoHeap) {
  const Robot robot;
  const std::array<Point, 4> path{Point{0, 0}, Point{2, 0}, Point{2, 1}, Point{0, 1}};
  int reached = 0;
  double off_m = 0.0;
  {
    const test::NoHeap no_heap;
    const Kinematics kinematics(robot.base);
    Odometry odometry(kinematics);
    Limiter limiter(robot.limits);
    PathFollower follower(robot.limits);
    SlipMonitor slip(kinematics, robot.base.wheel_radius_m, {});
    PoseFilter filter;
    Instant now{};
    odometry.reset({});
    (void)filter.reset({}, covariance_of(0.1, 0.1, 0.1), now);
    (void)follower.start(path, {});
    WheelValues angles{};
    odometry.update(angles);
    for (int cycle = 1; cycle <= 6000; ++cycle) {
      now += rates::kCycle;
      const Twist wanted =
          follower.update({.pose = odometry.pose(), .moving = limiter.current(), .dt = rates::kCycle}).command;
      const WheelValues speeds = kinematics.wheel_speeds(limiter.limit(wanted, rates::kCycle));
      (void)kinematics.saturation(speeds);
      for (std::size_t i = 0; i < angles.size(); ++i) {
        angles[i] += speeds[i] * seconds(rates::kCycle);
      }
      odometry.update(angles);
      (void)filter.predict(odometry.moved(), now);
      slip.update({.measured_radps = speeds, .commanded_radps = speeds});
      if (cycle % 10 == 0) {
        (void)filter.correct({odometry.pose(), covariance_of(0.05, 0.05, 0.05), now - 300 * rates::kCycle / 2});
        (void)filter.correct({{1e6, 0, 0}, covariance_of(0.05, 0.05, 0.05), now});
      }
    }
    reached = static_cast<int>(filter.accepted());
    off_m = std::hypot(odometry.pose().x_m, odometry.pose().y_m - 1.0);
  }
  EXPECT_GT(reached, 0);
  EXPECT_LT(off_m, 0.1) << "the path was driven to its end";
}

#ifdef IVO_HEAP_TRAP

void* volatile kept = nullptr;  // where a compiler cannot see that it is not used

TEST(HeapTrapDeathTest, EndsWhoeverAllocatesByName) {
  EXPECT_DEATH(
      {
        const test::NoHeap no_heap;
        kept = std::malloc(1);
      },
      "heap trap: malloc was called");
  EXPECT_DEATH(
      {
        const test::NoHeap no_heap;
        kept = new int(1);
      },
      "heap trap: malloc was called");
  EXPECT_DEATH(
      {
        const test::NoHeap no_heap;
        kept = std::calloc(1, 1);
      },
      "heap trap: calloc was called");
  EXPECT_DEATH(
      {
        const test::NoHeap no_heap;
        kept = std::aligned_alloc(64, 64);
      },
      "heap trap: aligned_alloc was called");
  EXPECT_DEATH(
      {
        kept = std::malloc(1);
        const test::NoHeap no_heap;
        kept = std::realloc(kept, 1 << 20);
      },
      "heap trap: realloc was called");
  EXPECT_DEATH(
      {
        kept = std::malloc(1);
        const test::NoHeap no_heap;
        std::free(kept);
      },
      "heap trap: free was called");
}

TEST(HeapTrap, LetsOthersAllocateBeforeAndAfter) {
  kept = std::malloc(1);
  { const test::NoHeap no_heap; }
  std::free(kept);
}

TEST(HeapTrapDeathTest, EigenAssertsWhereItWouldAllocate) {
  EXPECT_DEATH(
      {
        volatile int rows = 3;
        Eigen::MatrixXd grown(rows, rows);
        kept = grown.data();
      },
      "heap allocation is forbidden");
}

TEST(HeapTrapDeathTest, EigenAssertsSizesThatDoNotFit) {
  EXPECT_DEATH(
      {
        const Eigen::Vector3d three = Eigen::Vector3d::Ones();
        volatile int place = 3;
        volatile double beyond = three[place];
        (void)beyond;
      },
      "Assertion");
}

#endif

}  // namespace
}  // namespace ivo::firmware
