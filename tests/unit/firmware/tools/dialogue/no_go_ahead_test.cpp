#include "firmware/tools/dialogue/no_go_ahead.hpp"

#include <gtest/gtest.h>

namespace ivo::firmware {
namespace {

using console::AreaPurpose;

/// From (1, 1) to (9, 1) and up to (9, 9).
planner::AgentPath way_around_a_corner() {
  planner::AgentPath path;
  for (const Point point : {Point{1, 1}, Point{9, 1}, Point{9, 9}}) {
    (void)path.waypoints.push_back(point);
  }
  path.length_m = 16.0;
  return path;
}

console::AreaBoard square(double x_m, double y_m, AreaPurpose purpose = AreaPurpose::kNoGo, std::uint8_t agent = 0) {
  console::AreaBoard board({.agents = 2, .width_m = 20, .height_m = 20});
  console::AreaCommand area;
  area.purpose = purpose;
  area.agent = agent;
  area.corners = 4;
  area.corner[0] = {x_m, y_m};
  area.corner[1] = {x_m + 1, y_m};
  area.corner[2] = {x_m + 1, y_m + 1};
  area.corner[3] = {x_m, y_m + 1};
  EXPECT_EQ(board.put(area), console::Verdict::kAccepted);
  return board;
}

TEST(NoGoAhead, IsOnTheWayBetweenPlaces) {
  const planner::AgentPath path = way_around_a_corner();
  EXPECT_TRUE(leads_into_no_go(path, path.length_m, square(4, 0.5), 0));
  EXPECT_TRUE(leads_into_no_go(path, path.length_m, square(8.5, 5), 0));
  EXPECT_FALSE(leads_into_no_go(path, path.length_m, square(4, 3), 0));
}

TEST(NoGoAhead, IsNotWhatLiesBehind) {
  const planner::AgentPath path = way_around_a_corner();
  EXPECT_TRUE(leads_into_no_go(path, 12.1, square(4, 0.5), 0)) << "from (4.9, 1)";
  EXPECT_FALSE(leads_into_no_go(path, 11.9, square(4, 0.5), 0)) << "from (5.1, 1)";
  EXPECT_TRUE(leads_into_no_go(path, 11.9, square(8.5, 5), 0));
  EXPECT_FALSE(leads_into_no_go(path, 0.0, square(8.5, 8.5), 0)) << "the path is at its end";
}

TEST(NoGoAhead, IsWhatIsClosedToThatAgent) {
  const planner::AgentPath path = way_around_a_corner();
  EXPECT_FALSE(leads_into_no_go(path, 16.0, square(4, 0.5), 1));
  EXPECT_TRUE(leads_into_no_go(path, 16.0, square(4, 0.5, AreaPurpose::kNoGo, console::AreaCommand::kEverybody), 1));
  EXPECT_FALSE(leads_into_no_go(path, 16.0, square(4, 0.5, AreaPurpose::kPreferred), 0));
}

TEST(NoGoAhead, NobodyIsLedAnywhereByAPathOfOnePlace) {
  planner::AgentPath path;
  (void)path.waypoints.push_back({1, 1});
  EXPECT_FALSE(leads_into_no_go(path, 0.0, square(0.5, 0.5), 0));
}

}  // namespace
}  // namespace ivo::firmware
