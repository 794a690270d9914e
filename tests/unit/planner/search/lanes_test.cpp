#include "planner/search/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace ivo::planner {
namespace {

std::int32_t across(Spot s, int number) { return number % 2 != 0 ? s.y : s.x; }

LaneTeam random_team(std::mt19937_64& random) {
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
  };
  LaneTeam team;
  team.width = between(8, 60) * kTicksAMetre;
  team.height = between(8, 60) * kTicksAMetre;
  team.border = between(10, 40);
  team.agents = between(1, std::min(4, limits::kAgents));
  for (int m = 0; m < team.agents; ++m) {
    team.starts[index(m)] = {between(team.border, team.width - team.border),
                             between(team.border, team.height - team.border)};
    team.sight[index(m)] = between(60, 260);
    team.sweep[index(m)] = team.sight[index(m)] * between(1, 6);
  }
  return team;
}

// Where the lanes of an agent lie, one a lane, in the order in which they are gone along.
std::vector<std::int32_t> lanes_of(const Lanes& waypoints, int number) {
  std::vector<std::int32_t> lanes;
  for (std::size_t i = 0; i + 1 < waypoints.size(); i += 2) {
    EXPECT_EQ(across(waypoints[i], number), across(waypoints[i + 1], number)) << "a lane is straight";
    lanes.push_back(across(waypoints[i], number));
  }
  return lanes;
}

template <class OnPlan>
void on_random_plans(std::uint64_t seed, OnPlan&& on_plan) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < 300; ++i) {
    const LaneTeam team = random_team(random);
    for (int number = 0; number < kLanePlans; ++number) {
      SCOPED_TRACE("team " + std::to_string(i) + ", plan " + std::to_string(number));
      on_plan(team, number);
      ASSERT_FALSE(testing::Test::HasFailure());
    }
  }
}

TEST(Lanes, KeepEveryWaypointOnTheMapAndOffItsBorder) {
  on_random_plans(41, [](const LaneTeam& team, int number) {
    Lanes lanes;
    for (int m = 0; m < team.agents; ++m) {
      fill_lanes(team, m, number, lanes);
      ASSERT_GE(lanes.size(), 2U);
      ASSERT_EQ(lanes.size() % 2, 0U);
      for (const Spot s : lanes) {
        EXPECT_GE(s.x, team.border);
        EXPECT_GE(s.y, team.border);
        EXPECT_LE(s.x, team.width - team.border);
        EXPECT_LE(s.y, team.height - team.border);
      }
    }
  });
}

TEST(Lanes, LieAtMostTwoSightRadiiApartAndOneFromTheStripsEdges) {
  on_random_plans(42, [](const LaneTeam& team, int number) {
    Lanes waypoints;
    const std::int32_t extent = number % 2 != 0 ? team.height : team.width;
    std::vector<std::pair<std::int32_t, std::int32_t>> reached;  // across: from, to
    for (int m = 0; m < team.agents; ++m) {
      fill_lanes(team, m, number, waypoints);
      const std::int32_t sight = team.sight[index(m)];
      const std::vector<std::int32_t> lanes = lanes_of(waypoints, number);
      for (std::size_t i = 1; i < lanes.size(); ++i) {
        EXPECT_LE(std::abs(lanes[i] - lanes[i - 1]), 2 * sight + 1);
      }
      const auto [low, high] = std::minmax_element(lanes.begin(), lanes.end());
      reached.emplace_back(*low - sight, *high + sight);
    }
    // The strips leave nothing between them: what each agent sees across its lanes covers the map.
    std::sort(reached.begin(), reached.end());
    std::int32_t to = 0;
    for (const auto& [low, high] : reached) {
      EXPECT_LE(low, to + 2);
      to = std::max(to, high);
    }
    EXPECT_GE(to, extent - 2);
  });
}

TEST(Lanes, GiveEachAgentAStripInTheOrderInWhichTheyStand) {
  on_random_plans(43, [](const LaneTeam& team, int number) {
    std::vector<int> order(index(team.agents));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return across(team.starts[index(a)], number) < across(team.starts[index(b)], number);
    });
    Lanes waypoints;
    std::int32_t passed = -1;
    for (const int m : order) {
      fill_lanes(team, m, number, waypoints);
      const std::vector<std::int32_t> lanes = lanes_of(waypoints, number);
      const auto [low, high] = std::minmax_element(lanes.begin(), lanes.end());
      EXPECT_GE(*low, passed);
      passed = *high;
    }
  });
}

TEST(Lanes, BeginAtTheSideOfTheStripWhereTheAgentStands) {
  LaneTeam team{.width = 2'560, .height = 2'560, .border = 26, .agents = 1, .starts = {}, .sight = {}, .sweep = {}};
  team.sight[0] = 160;
  team.sweep[0] = 160;
  Lanes lanes;
  for (int number = 0; number < kLanePlans; ++number) {
    team.starts[0] = {100, 100};
    fill_lanes(team, 0, number, lanes);
    EXPECT_EQ(lanes.size(), 16U);  // 40 m in lanes of 5 m
    EXPECT_LT(lanes[0].x, 400);
    EXPECT_LT(lanes[0].y, 400);
    team.starts[0] = {2'460, 2'460};
    fill_lanes(team, 0, number, lanes);
    EXPECT_GT(lanes[0].x, 2'160);
    EXPECT_GT(lanes[0].y, 2'160);
  }
}

TEST(Lanes, AreNoneWhereTheyWouldNeedMoreWaypointsThanThereIsRoom) {
  LaneTeam team{.width = 1 << 20, .height = 2'560, .border = 26, .agents = 1, .starts = {}, .sight = {}, .sweep = {}};
  team.sight[0] = 8;
  team.sweep[0] = 8;
  Lanes lanes;
  fill_lanes(team, 0, 0, lanes);
  EXPECT_TRUE(lanes.empty());
  fill_lanes(team, 0, 1, lanes);
  EXPECT_FALSE(lanes.empty());
}

TEST(Lanes, LeaveRoomForTheStart) {
  LaneTeam team{.width = 0, .height = 2'560, .border = 26, .agents = 1, .starts = {}, .sight = {}, .sweep = {}};
  team.sight[0] = 8;
  team.sweep[0] = 8;
  Lanes lanes;
  for (const int count : {limits::kWaypoints / 2, limits::kWaypoints / 2 - 1}) {
    team.width = count * 2 * team.sight[0];
    fill_lanes(team, 0, 0, lanes);
    EXPECT_LE(lanes.size() + 1, limits::kWaypoints);
    EXPECT_EQ(lanes.empty(), 2 * count + 1 > limits::kWaypoints);
  }
}

}  // namespace
}  // namespace ivo::planner
