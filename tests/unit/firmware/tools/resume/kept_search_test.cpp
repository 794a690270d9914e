#include "firmware/tools/resume/kept_search.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace ivo::firmware {
namespace {

using std::chrono_literals::operator""ms;

std::unique_ptr<KeptSearch> example() {
  auto kept = std::make_unique<KeptSearch>();
  kept->world = "can0";
  kept->sources = {{"mission.toml", 0x0123456789ABCDEF}, {"map.png", 2}};
  kept->unix_time_s = 1'700'000'000;
  kept->at_s = 12.25;
  kept->log_bytes = 4711;
  kept->planned = true;
  kept->consented = true;
  ResumedSearch& search = kept->search;
  search.plan.paths.resize(2);
  for (planner::AgentPath& path : search.plan.paths) {
    path.length_m = 5.5;
    path.duration_s = 11.0;
    path.waypoints.resize(3);
    path.waypoints[1] = {0.1, -0.2};
  }
  search.plan.score = {1.5, 2.5, 3.5, 4.5, 0.01, 6.5, true};
  search.generations = 300;
  search.started = true;
  search.progress.tracks[0] = {{1, 2}, 3.0, 0.0, 4500ms, true};
  search.progress.tracks[1] = {{5, 6}, 7.0, 2.5, 8500ms, false};
  search.progress.elapsed = 9500ms;
  search.progress.state = SearchState::kFound;
  search.progress.finder = 1;
  search.robot = {1, 2, 0.5};
  search.distance_left_m = 2.5;
  return kept;
}

TEST(KeptSearch, ReadsBackAsItWasWritten) {
  const auto kept = example();
  const std::string bytes = to_bytes(*kept);
  const auto read = std::make_unique<KeptSearch>();
  ASSERT_TRUE(from_bytes(bytes, *read));
  EXPECT_EQ(to_bytes(*read), bytes);
  EXPECT_EQ(read->world, "can0");
  EXPECT_EQ(read->sources, kept->sources);
  EXPECT_EQ(read->at_s, kept->at_s);
  EXPECT_EQ(read->log_bytes, kept->log_bytes);
  EXPECT_TRUE(read->consented);
  EXPECT_FALSE(read->ended);
  EXPECT_EQ(read->search.plan.paths[1].waypoints[1], (Point{0.1, -0.2}));
  EXPECT_EQ(read->search.plan.score.horizon_s, 6.5);
  EXPECT_EQ(read->search.generations, 300);
  EXPECT_EQ(read->search.progress.tracks[1].under_way, 8500ms);
  EXPECT_EQ(read->search.progress.tracks[1].moved_m, 7.0);
  EXPECT_EQ(read->search.progress.tracks[1].before_m, 2.5) << "of it, before the plan that is followed now";
  EXPECT_TRUE(read->search.progress.tracks[0].path_ended);
  EXPECT_EQ(read->search.progress.finder, 1);
  EXPECT_EQ(read->search.robot.heading_rad, 0.5);
  EXPECT_EQ(read->search.distance_left_m, 2.5);
}

TEST(KeptSearch, OneWithoutAPlanIsShort) {
  const auto kept = example();
  kept->planned = false;
  EXPECT_LT(to_bytes(*kept).size(), 100U);
  const auto read = std::make_unique<KeptSearch>();
  ASSERT_TRUE(from_bytes(to_bytes(*kept), *read));
  EXPECT_FALSE(read->planned);
}

TEST(KeptSearch, RefusesEveryPartOfItselfAndWhatIsLonger) {
  const std::string bytes = to_bytes(*example());
  const auto read = std::make_unique<KeptSearch>();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(from_bytes(bytes.substr(0, length), *read)) << length;
  }
  EXPECT_FALSE(from_bytes(bytes + '\0', *read));
}

TEST(KeptSearch, RefusesMoreAgentsThanThereIsRoomFor) {
  const auto kept = example();
  const std::string bytes = to_bytes(*kept);
  kept->planned = false;
  std::string more = bytes;
  more[to_bytes(*kept).size()] = static_cast<char>(limits::kAgents + 1);
  const auto read = std::make_unique<KeptSearch>();
  EXPECT_FALSE(from_bytes(more, *read));
}

}  // namespace
}  // namespace ivo::firmware
