#include "firmware/tools/dialogue/drawn_areas.hpp"

#include <gtest/gtest.h>

namespace ivo::firmware {
namespace {

using console::AreaCommand;
using console::AreaPurpose;

AreaCommand square(std::uint8_t slot, AreaPurpose purpose, std::uint8_t agent, double x_m) {
  AreaCommand area;
  area.slot = slot;
  area.purpose = purpose;
  area.agent = agent;
  area.corners = 4;
  area.corner[0] = {x_m, 1};
  area.corner[1] = {x_m + 1, 1};
  area.corner[2] = {x_m + 1, 2};
  area.corner[3] = {x_m, 2};
  return area;
}

Polygon square_at(double x_m) { return {{x_m, 1}, {x_m + 1, 1}, {x_m + 1, 2}, {x_m, 2}}; }

class DrawnAreasTest : public testing::Test {
 protected:
  DrawnAreasTest() {
    mission_.agents.resize(2);
    mission_.agents[0].name = "IVO";
    mission_.agents[1].name = "Ana";
    mission_.agents[1].preferred = {square_at(90)};
    mission_.agents[1].restricted = {square_at(80), square_at(70)};
  }
  void put(const AreaCommand& area) { ASSERT_EQ(board_.put(area), console::Verdict::kAccepted); }

  Mission mission_;
  console::BoardRules rules_{.agents = 2, .width_m = 100, .height_m = 50};
  console::AreaBoard board_{rules_};
  PreferredSlots slots_;
};

TEST_F(DrawnAreasTest, TakeThePlaceOfTheMissionsOwn) {
  const std::vector<AgentSpec> agents = agents_with(mission_.agents, board_, true, slots_);
  ASSERT_EQ(agents.size(), 2U);
  EXPECT_EQ(agents[1].name, "Ana");
  EXPECT_TRUE(agents[1].preferred.empty());
  EXPECT_TRUE(agents[1].restricted.empty());
  EXPECT_TRUE(slots_[1].empty());
}

TEST_F(DrawnAreasTest, GoToWhomTheyAreDrawnForWithTheSlotsTheyCameFrom) {
  put(square(7, AreaPurpose::kPreferred, 1, 10));
  put(square(2, AreaPurpose::kPreferred, 1, 20));
  put(square(3, AreaPurpose::kPreferred, 0, 30));
  put(square(4, AreaPurpose::kNoGo, 0, 40));
  put(square(5, AreaPurpose::kNoGo, AreaCommand::kEverybody, 50));
  const std::vector<AgentSpec> agents = agents_with(mission_.agents, board_, true, slots_);
  EXPECT_EQ(agents[0].preferred, (std::vector<Polygon>{square_at(30)}));
  EXPECT_EQ(agents[0].restricted, (std::vector<Polygon>{square_at(40), square_at(50)}));
  EXPECT_EQ(agents[1].preferred, (std::vector<Polygon>{square_at(20), square_at(10)})) << "by slot";
  EXPECT_EQ(agents[1].restricted, (std::vector<Polygon>{square_at(50)}));
  EXPECT_EQ(slots_[0], (std::vector<std::uint8_t>{3}));
  EXPECT_EQ(slots_[1], (std::vector<std::uint8_t>{2, 7}));
}

TEST_F(DrawnAreasTest, OnlyNoGoCountsWhereNobodyAsksForPreferredOnes) {
  put(square(7, AreaPurpose::kPreferred, 1, 10));
  put(square(5, AreaPurpose::kNoGo, 1, 50));
  const std::vector<AgentSpec> agents = agents_with(mission_.agents, board_, false, slots_);
  EXPECT_TRUE(agents[1].preferred.empty());
  EXPECT_EQ(agents[1].restricted, (std::vector<Polygon>{square_at(50)}));
  EXPECT_TRUE(slots_[1].empty());
}

TEST_F(DrawnAreasTest, TheMissionsOwnAreDrawnAtFirst) {
  console::ConsoleDesk desk(rules_, {}, {});
  EXPECT_TRUE(draw(mission_, desk));
  const console::AreaBoard board = desk.areas();
  const std::vector<AgentSpec> agents = agents_with(mission_.agents, board, true, slots_);
  EXPECT_EQ(agents[1].preferred, mission_.agents[1].preferred);
  EXPECT_EQ(agents[1].restricted, mission_.agents[1].restricted);
  EXPECT_TRUE(agents[0].restricted.empty());
  EXPECT_EQ(slots_[1], (std::vector<std::uint8_t>{0}));
}

TEST_F(DrawnAreasTest, WhatHasNoRoomAtTheConsoleIsLeftOutAndThatIsSaid) {
  mission_.agents[1].restricted.assign(60, square_at(20));
  mission_.agents[1].restricted[1] = square_at(400);  // off the map
  console::ConsoleDesk desk(rules_, {}, {});
  EXPECT_FALSE(draw(mission_, desk));
  const std::vector<AgentSpec> agents = agents_with(mission_.agents, desk.areas(), true, slots_);
  EXPECT_EQ(agents[1].restricted, std::vector<Polygon>(limits::kAreas, square_at(20)));
}

TEST(DrawnArea, ItsSizeIsTheSameWhicheverWayRoundItIsDrawn) {
  EXPECT_DOUBLE_EQ(area_m2({{0, 0}, {4, 0}, {4, 3}}), 6.0);
  EXPECT_DOUBLE_EQ(area_m2({{4, 3}, {4, 0}, {0, 0}}), 6.0);
  EXPECT_DOUBLE_EQ(area_m2({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}), 10.0);
}

}  // namespace
}  // namespace ivo::firmware
