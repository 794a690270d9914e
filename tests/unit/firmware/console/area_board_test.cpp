#include "firmware/console/area_board.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace ivo::firmware::console {
namespace {

AreaCommand area_of(std::initializer_list<Corner> corners, AreaPurpose purpose = AreaPurpose::kPreferred,
                    std::uint8_t agent = 0) {
  AreaCommand area;
  area.purpose = purpose;
  area.agent = agent;
  for (const Corner corner : corners) {
    area.corner[area.corners++] = corner;
  }
  return area;
}

AreaCommand square_at(double x_m, double y_m, AreaPurpose purpose = AreaPurpose::kPreferred, std::uint8_t agent = 0) {
  return area_of({{x_m, y_m}, {x_m + 2, y_m}, {x_m + 2, y_m + 2}, {x_m, y_m + 2}}, purpose, agent);
}

class AreaBoardTest : public testing::Test {
 protected:
  Verdict put(AreaCommand area, std::uint8_t slot = 0) {
    area.slot = slot;
    return board_.put(area);
  }
  AreaBoard board_{{.agents = 2, .width_m = 20, .height_m = 10}};
};

TEST_F(AreaBoardTest, IsEmptyAtFirstAndItsRevisionGrowsWithEachChange) {
  EXPECT_EQ(board_.revision(), 1U);
  ASSERT_EQ(put(square_at(1, 1), 4), Verdict::kAccepted);
  EXPECT_EQ(board_.revision(), 2U);
  ASSERT_TRUE(board_.slots()[4]);
  EXPECT_EQ(board_.slots()[4]->corners, 4);
  EXPECT_EQ(board_.slots()[4]->corner[2].x_m, 3);
  ASSERT_EQ(put(square_at(5, 1), 4), Verdict::kAccepted);
  EXPECT_EQ(board_.revision(), 3U);
  EXPECT_EQ(board_.slots()[4]->corner[0].x_m, 5) << "drawn anew";
  board_.remove(4);
  EXPECT_EQ(board_.revision(), 4U);
  EXPECT_FALSE(board_.slots()[4]);
  board_.remove(4);
  EXPECT_EQ(board_.revision(), 4U) << "nothing was there";
}

TEST_F(AreaBoardTest, RefusesAgentsThatTheMissionDoesNotHave) {
  EXPECT_EQ(put(square_at(1, 1, AreaPurpose::kPreferred, 1)), Verdict::kAccepted);
  EXPECT_EQ(put(square_at(1, 1, AreaPurpose::kPreferred, 2)), Verdict::kOutOfRange);
  EXPECT_EQ(put(square_at(1, 1, AreaPurpose::kNoGo, AreaCommand::kEverybody)), Verdict::kAccepted);
  EXPECT_EQ(board_.revision(), 3U);
}

TEST_F(AreaBoardTest, RefusesBordersThatAreNone) {
  EXPECT_EQ(put(area_of({{1, 1}, {5, 5}, {5, 1}, {1, 5}})), Verdict::kNotAnArea) << "a bow tie";
  EXPECT_EQ(put(area_of({{1, 1}, {3, 3}, {5, 5}})), Verdict::kNotAnArea) << "a line";
  EXPECT_EQ(put(area_of({{1, 1}, {1, 1}, {5, 5}})), Verdict::kNotAnArea) << "a corner twice";
  EXPECT_EQ(put(area_of({{1, 1}, {5, 1}, {5, 5}, {5, 1}})), Verdict::kNotAnArea) << "folded back";
  EXPECT_EQ(board_.revision(), 1U);
}

TEST_F(AreaBoardTest, RefusesWhatLiesOffTheMapAndTakesWhatReachesOntoIt) {
  EXPECT_EQ(put(square_at(-2, 1)), Verdict::kOutOfRange) << "touches the edge";
  EXPECT_EQ(put(square_at(20, 1)), Verdict::kOutOfRange);
  EXPECT_EQ(put(square_at(1, 10)), Verdict::kOutOfRange);
  EXPECT_EQ(put(square_at(1, -2)), Verdict::kOutOfRange);
  EXPECT_EQ(put(square_at(-1, 9)), Verdict::kAccepted);
  EXPECT_EQ(put(area_of({{-100, -100}, {100, -100}, {100, 100}, {-100, 100}}), 1), Verdict::kAccepted);
}

TEST_F(AreaBoardTest, TakesNoMoreOfAnAgentThanAPlanCanHeed) {
  for (int i = 0; i < limits::kAreas; ++i) {
    ASSERT_EQ(put(square_at(1, 1), static_cast<std::uint8_t>(i)), Verdict::kAccepted) << i;
  }
  EXPECT_EQ(put(square_at(1, 1), limits::kAreas), Verdict::kOutOfRange);
  EXPECT_EQ(put(square_at(5, 5), 0), Verdict::kAccepted) << "to move one takes no more room";
  EXPECT_EQ(put(square_at(1, 1, AreaPurpose::kPreferred, 1), limits::kAreas), Verdict::kAccepted) << "another agent's";
  EXPECT_EQ(put(square_at(1, 1, AreaPurpose::kNoGo, 0), limits::kAreas + 1), Verdict::kAccepted) << "another purpose";
  board_.remove(0);
  EXPECT_EQ(put(square_at(1, 1), limits::kAreas + 2), Verdict::kAccepted);
}

TEST_F(AreaBoardTest, ANoGoForEverybodyTakesRoomOfEachAgent) {
  for (int i = 0; i < limits::kAreas; ++i) {
    const std::uint8_t who = i % 2 == 0 ? AreaCommand::kEverybody : std::uint8_t{1};
    ASSERT_EQ(put(square_at(1, 1, AreaPurpose::kNoGo, who), static_cast<std::uint8_t>(i)), Verdict::kAccepted) << i;
  }
  constexpr std::uint8_t kNext = limits::kAreas;
  EXPECT_EQ(put(square_at(1, 1, AreaPurpose::kNoGo, 1), kNext), Verdict::kOutOfRange);
  EXPECT_EQ(put(square_at(1, 1, AreaPurpose::kNoGo, AreaCommand::kEverybody), kNext), Verdict::kOutOfRange);
  EXPECT_EQ(put(square_at(1, 1, AreaPurpose::kNoGo, 0), kNext), Verdict::kAccepted);
}

}  // namespace
}  // namespace ivo::firmware::console
