// A loop that takes up a search which another one was cut off from.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/support/search_rig.hpp"

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""s;
using test::SearchRig;

// What is kept of a search after `time` of it.
std::unique_ptr<ResumedSearch> left_off_after(Duration time, const SearchRig::Options& options = {}) {
  SearchRig rig(options);
  EXPECT_TRUE(rig.start_search());
  rig.run(time);
  const LoopStatus& status = rig.loop().status();
  auto left = std::make_unique<ResumedSearch>();
  left->plan = rig.loop().plan();
  left->started = status.search_started;
  left->progress = {
      .tracks = status.tracks, .elapsed = status.search_time, .state = status.search, .finder = status.finder};
  left->robot = status.robot;
  left->distance_left_m = status.distance_left_m;
  return left;
}

TEST(ResumedSearch, StandsWhereItWasLeftUntilSomebodyAgrees) {
  const auto left = left_off_after(12s);
  ASSERT_GT(left->progress.tracks[0].moved_m, 2.0);
  SearchRig rig({.resumed = left.get()});
  ASSERT_TRUE(rig.run_until(Mode::kAwaitingConsent));
  for (int i = 0; i < 2000; ++i) {
    const LoopStatus& status = rig.cycle();
    ASSERT_EQ(status.mode, Mode::kAwaitingConsent);
    ASSERT_FALSE(rig.wheels_turn());
    ASSERT_EQ(status.tracks[0].position, left->progress.tracks[0].position);
    ASSERT_EQ(status.tracks[1].position, left->progress.tracks[1].position);
    ASSERT_EQ(status.search_time, left->progress.elapsed);
    ASSERT_TRUE(status.search_started);
    ASSERT_FALSE(status.consented);
  }
  const auto events = rig.events();
  EXPECT_FALSE(std::any_of(events.begin(), events.end(), [](const Event& event) {
    return event.kind == EventKind::kPlanReady || event.kind == EventKind::kPosition;
  })) << "nothing is planned anew";
}

TEST(ResumedSearch, GoesOnAlongTheSamePathToItsEnd) {
  const auto left = left_off_after(12s);
  SearchRig rig({.resumed = left.get()});
  ASSERT_TRUE(rig.start_search());
  rig.run(1s);
  const LoopStatus& begun = rig.loop().status();
  EXPECT_TRUE(begun.consented);
  EXPECT_GT(begun.search_time, left->progress.elapsed);
  EXPECT_LT(begun.distance_left_m, left->distance_left_m);
  EXPECT_GT(begun.distance_left_m, left->distance_left_m - 0.5);
  ASSERT_TRUE(rig.run_until(Mode::kDone));
  const LoopStatus& status = rig.loop().status();
  const planner::AgentPath& path = rig.loop().plan().paths[0];
  EXPECT_EQ(status.search, SearchState::kPathsEnded);
  EXPECT_NEAR(status.robot.x_m, path.waypoints.back().x_m, 0.06);
  EXPECT_NEAR(status.robot.y_m, path.waypoints.back().y_m, 0.06);
  EXPECT_NEAR(status.tracks[0].moved_m, path.length_m, 0.05 * path.length_m);
  EXPECT_EQ(status.counters.refused_commands, 0U);
}

TEST(ResumedSearch, ThatHadFoundTheObjectEndsWithoutAMove) {
  const auto left = left_off_after(30s, {.object = Point{2.0, 4.6}});
  ASSERT_EQ(left->progress.state, SearchState::kFound);
  SearchRig rig({.object = Point{2.0, 4.6}, .resumed = left.get()});
  ASSERT_TRUE(rig.run_until(Mode::kDone));
  EXPECT_EQ(rig.loop().status().finder, left->progress.finder);
  EXPECT_EQ(rig.loop().status().search_time, left->progress.elapsed);
  EXPECT_FALSE(rig.wheels_turn());
}

TEST(ResumedSearch, ThatNobodyHadAgreedToStartsFromTheBeginning) {
  const auto left = left_off_after(0s);
  left->started = false;
  SearchRig rig({.resumed = left.get()});
  ASSERT_TRUE(rig.run_until(Mode::kAwaitingConsent));
  EXPECT_FALSE(rig.loop().status().search_started);
  ASSERT_TRUE(rig.start_search());
  ASSERT_TRUE(rig.run_until(Mode::kDone));
  EXPECT_NEAR(rig.loop().status().tracks[0].moved_m, left->plan.paths[0].length_m, 0.05 * left->plan.paths[0].length_m);
}

}  // namespace
}  // namespace ivo::firmware
