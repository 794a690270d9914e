// From the state that was kept and the log of what came after it to where the search really stood.
#include "firmware/tools/resume/replay.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

const std::vector<std::string> kNames = {"IVO", "Ana"};

class ReplayTest : public ::testing::Test {
 protected:
  ReplayTest() : kept_(std::make_unique<KeptSearch>()) {
    std::string folder = ::testing::TempDir() + "replay.XXXXXX";
    folder_ = ::mkdtemp(folder.data());
    kept_->planned = true;
    ResumedSearch& search = kept_->search;
    search.plan.paths.resize(2);
    for (const Point point : {Point{0, 0}, Point{4, 0}, Point{4, 4}}) {
      (void)search.plan.paths[0].waypoints.push_back(point);
      (void)search.plan.paths[1].waypoints.push_back({point.x_m + 10, point.y_m});
    }
    search.plan.paths[0].length_m = search.plan.paths[1].length_m = 8.0;
    (void)searchers_.push_back({.kind = AgentKind::kRobot, .start = {0, 0}});
    (void)searchers_.push_back({.kind = AgentKind::kPerson, .start = {10, 0}, .speed_mps = 1.0});
  }
  ~ReplayTest() override { std::filesystem::remove_all(folder_); }

  // As it was kept 3 s after they had set off at 5 s.
  void keep_at_three_seconds() {
    kept_->at_s = 8.0;
    kept_->consented = true;
    ResumedSearch& search = kept_->search;
    search.started = true;
    search.robot = {1.5, 0, 0.2};
    search.distance_left_m = 6.5;
    search.progress = {.tracks = {AgentTrack{{1.5, 0}, 1.5, 0.0, 3s, false}, AgentTrack{{13, 0}, 3.0, 0.0, 3s, false}},
                       .elapsed = 3s,
                       .state = {},
                       .finder = {}};
  }
  LoggedRun logged(const std::string& text) {
    const std::string path = folder_ + "/events.jsonl";
    std::ofstream(path) << text;
    Result<LoggedRun> run = read_logged_run(path, kNames);
    EXPECT_TRUE(run.ok());
    return std::move(run).value();
  }
  ResumedSearch& after(const std::string& text) {
    replay(logged(text), searchers_, {0, 0, 0.2}, *kept_);
    return kept_->search;
  }

  std::string folder_;
  Searchers searchers_;
  std::unique_ptr<KeptSearch> kept_;
};

std::string position(double t_s, const char* agent, double x_m, double y_m) {
  return "{\"t_s\":" + std::to_string(t_s) + ",\"event\":\"position\",\"agent\":\"" + agent +
         "\",\"x_m\":" + std::to_string(x_m) + ",\"y_m\":" + std::to_string(y_m) + "}\n";
}

TEST_F(ReplayTest, WithoutNewsItStandsWhereItWasKept) {
  keep_at_three_seconds();
  const ResumedSearch& search = after("");
  EXPECT_EQ(search.progress.elapsed, 3s);
  EXPECT_EQ(search.robot.x_m, 1.5);
}

TEST_F(ReplayTest, WhatWasLoggedAfterwardsIsNotLost) {
  keep_at_three_seconds();
  const ResumedSearch& search =
      after(position(8.0, "IVO", 1.5, 0) + position(8.0, "Ana", 13, 0) + position(8.25, "IVO", 1.625, 0) +
            position(8.25, "Ana", 13.25, 0) + position(8.5, "IVO", 1.75, 0) + position(8.5, "Ana", 13.5, 0));
  EXPECT_EQ(search.progress.elapsed, 3500ms);
  EXPECT_EQ(search.progress.tracks[0].position, (Point{1.75, 0}));
  EXPECT_DOUBLE_EQ(search.progress.tracks[0].moved_m, 1.75);
  EXPECT_EQ(search.progress.tracks[0].under_way, 3500ms);
  EXPECT_DOUBLE_EQ(search.progress.tracks[1].moved_m, 3.5);
  EXPECT_EQ(search.robot.x_m, 1.75);
  EXPECT_EQ(search.robot.heading_rad, 0.2);
  EXPECT_DOUBLE_EQ(search.distance_left_m, 6.25);
}

TEST_F(ReplayTest, LinesThatTheStateAlreadyHoldsChangeNothing) {
  keep_at_three_seconds();
  const ResumedSearch& search = after(position(7.8, "IVO", 1.4, 0) + position(7.8, "Ana", 12.8, 0));
  EXPECT_EQ(search.progress.elapsed, 3s);
  EXPECT_EQ(search.robot.x_m, 1.5);
  EXPECT_EQ(search.progress.tracks[1].moved_m, 3.0);
}

TEST_F(ReplayTest, ASearchThatHadJustSetOffIsUnderWay) {
  const ResumedSearch& search = after(
      "{\"t_s\":5,\"event\":\"consent\"}\n{\"t_s\":5.5,\"event\":\"search started\"}\n" + position(5.5, "IVO", 0, 0) +
      position(5.5, "Ana", 10, 0) + position(5.75, "IVO", 0.125, 0) + position(5.75, "Ana", 10.25, 0));
  EXPECT_TRUE(search.started);
  EXPECT_TRUE(kept_->consented);
  EXPECT_EQ(search.progress.elapsed, 250ms);
  EXPECT_DOUBLE_EQ(search.progress.tracks[0].moved_m, 0.125);
  EXPECT_DOUBLE_EQ(search.distance_left_m, 7.875);
}

TEST_F(ReplayTest, TimeInWhichNobodySearchedDoesNotCount) {
  keep_at_three_seconds();
  const ResumedSearch& search = after(
      position(8.25, "IVO", 1.625, 0) + position(8.25, "Ana", 13.25, 0) +
      "{\"t_s\":8.25,\"event\":\"resumed\",\"search_time_s\":3.25}\n{\"t_s\":100,\"event\":\"search started\"}\n" +
      position(100.25, "IVO", 1.75, 0) + position(100.25, "Ana", 13.5, 0));
  EXPECT_EQ(search.progress.elapsed, 3500ms);
  EXPECT_DOUBLE_EQ(search.progress.tracks[1].moved_m, 3.5);
}

TEST_F(ReplayTest, AFindIsNotSearchedForAgain) {
  keep_at_three_seconds();
  const ResumedSearch& search = after("{\"t_s\":8.125,\"event\":\"found\",\"agent\":\"Ana\",\"x_m\":13,\"y_m\":1}\n");
  EXPECT_EQ(search.progress.state, SearchState::kFound);
  EXPECT_EQ(search.progress.finder, 1);
  EXPECT_EQ(search.progress.elapsed, 3125ms);
}

TEST_F(ReplayTest, ATornLastLineIsCutOffAndAnUnreadableOneIsCounted) {
  const std::string good = position(8.25, "IVO", 1.625, 0);
  const LoggedRun run = logged(good + "rubbish\n" + position(8.25, "Bob", 1, 1) + good.substr(0, 20));
  EXPECT_EQ(run.whole_bytes, good.size() + 8 + position(8.25, "Bob", 1, 1).size());
  EXPECT_EQ(run.unreadable, 2);
  EXPECT_EQ(run.tracks[0].size(), 1U);
  EXPECT_EQ(run.steps.size(), 1U);
  EXPECT_EQ(run.last_s, 8.25);
}

}  // namespace
}  // namespace ivo::firmware
