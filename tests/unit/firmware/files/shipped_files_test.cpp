// Every file under config/ that people start from.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <string>

#include "firmware/files/class_file.hpp"
#include "firmware/files/map_file.hpp"
#include "firmware/files/mission_file.hpp"
#include "firmware/files/robot_file.hpp"

namespace ivo::firmware {
namespace {

using enum SemanticClass;

const std::string kConfig = std::string(IVO_SOURCE_DIR) + "/config/";

MapFile shipped_map(const std::string& name) {
  Result<MapFile> map = read_map(kConfig + "maps/" + name + ".toml");
  EXPECT_TRUE(map.ok()) << map.error().message;
  return map.ok() ? std::move(map).value() : MapFile{};
}

/// Where the centre of a disc of `radius_m` may be, from `start`: by pixel, the bottom row first.
std::vector<bool> reachable(const planner::SegmentedMap& map, AgentKind kind, Point start, double radius_m) {
  const int reach = static_cast<int>(radius_m / map.resolution_m) + 1;
  const auto blocked = [&](int column, int row) {
    return column < 0 || row < 0 || column >= map.width_px || row >= map.height_px || map.obstacle(column, row);
  };
  const auto stands = [&](int column, int row) {
    if (blocked(column, row) || map.properties(map.at(column, row)).restricted[static_cast<std::size_t>(kind)]) {
      return false;
    }
    for (int dx = -reach; dx <= reach; ++dx) {
      for (int dy = -reach; dy <= reach; ++dy) {
        const double x = std::max(0.0, std::abs(dx) - 0.5) * map.resolution_m;
        const double y = std::max(0.0, std::abs(dy) - 0.5) * map.resolution_m;
        if (x * x + y * y < radius_m * radius_m && blocked(column + dx, row + dy)) {
          return false;
        }
      }
    }
    return true;
  };
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width_px) + static_cast<std::size_t>(column);
  };
  std::vector<bool> asked(map.pixels.size());
  std::vector<bool> reached(map.pixels.size());
  std::deque<std::array<int, 2>> front = {
      {static_cast<int>(start.x_m / map.resolution_m), static_cast<int>(start.y_m / map.resolution_m)}};
  while (!front.empty()) {
    const auto [column, row] = front.front();
    front.pop_front();
    if (blocked(column, row) || asked[index(column, row)]) {
      continue;
    }
    asked[index(column, row)] = true;
    if (stands(column, row)) {
      reached[index(column, row)] = true;
      front.insert(front.end(), {{column + 1, row}, {column - 1, row}, {column, row + 1}, {column, row - 1}});
    }
  }
  return reached;
}

/// Free pixels farther than `sight_m` from every reached one, walls ignored.
int out_of_sight(const planner::SegmentedMap& map, const std::vector<bool>& reached, double sight_m) {
  const int reach = static_cast<int>(sight_m / map.resolution_m);
  int count = 0;
  for (int row = 0; row < map.height_px; row += 2) {
    for (int column = 0; column < map.width_px; column += 2) {
      bool near = map.obstacle(column, row);
      for (int dy = -reach; dy <= reach && !near; ++dy) {
        for (int dx = -reach; dx <= reach && !near; ++dx) {
          const int c = column + dx;
          const int r = row + dy;
          near = c >= 0 && r >= 0 && c < map.width_px && r < map.height_px && dx * dx + dy * dy <= reach * reach &&
                 reached[static_cast<std::size_t>(r) * static_cast<std::size_t>(map.width_px) +
                         static_cast<std::size_t>(c)];
        }
      }
      count += near ? 0 : 1;
    }
  }
  return count;
}

TEST(ShippedRobot, IsTheBuiltInOne) {
  const auto robot = read_robot(kConfig + "robots/ivo.toml");
  ASSERT_TRUE(robot.ok()) << robot.error().message;
  EXPECT_EQ(robot.value(), Robot{});
}

TEST(ShippedFiles, ClassesAreTheBuiltInTable) {
  const auto file = read_classes(kConfig + "classes.toml");
  ASSERT_TRUE(file.ok()) << file.error().message;
  const ClassTable built_in = default_class_table();
  for (std::size_t i = 0; i < built_in.size(); ++i) {
    const std::string_view name = name_of(static_cast<SemanticClass>(i));
    EXPECT_TRUE(file.value().listed[i]) << name;
    EXPECT_EQ(file.value().classes[i].colour, built_in[i].colour) << name;
    EXPECT_EQ(file.value().classes[i].obstacle, built_in[i].obstacle) << name;
    EXPECT_EQ(file.value().classes[i].occluder, built_in[i].occluder) << name;
    EXPECT_EQ(file.value().classes[i].restricted, built_in[i].restricted) << name;
  }
}

TEST(ShippedFiles, EveryMissionReadsWithItsMapAndItsRobot) {
  int missions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kConfig + "missions")) {
    const auto file = read_mission(entry.path().string());
    ASSERT_TRUE(file.ok()) << file.error().message;
    const auto map = read_map(file.value().mission.map_path);
    ASSERT_TRUE(map.ok()) << map.error().message;
    const auto robot = read_robot(file.value().mission.agents[0].robot_path);
    ASSERT_TRUE(robot.ok()) << robot.error().message;
    for (const AgentSpec& agent : file.value().mission.agents) {
      const planner::SegmentedMap view = map.value().view();
      ASSERT_TRUE(view.contains(agent.start)) << entry.path() << agent.name;
      EXPECT_FALSE(view.obstacle(static_cast<int>(agent.start.x_m / view.resolution_m),
                                 static_cast<int>(agent.start.y_m / view.resolution_m)))
          << entry.path() << agent.name;
    }
    ++missions;
  }
  EXPECT_EQ(missions, 4);
}

TEST(ShippedFiles, MapsHaveTheirSizes) {
  const MapFile courtyard = shipped_map("courtyard");
  EXPECT_EQ(courtyard.view().width_m(), 21.0);
  EXPECT_EQ(courtyard.view().height_m(), 27.0);
  for (const std::string name : {"m1", "m2"}) {
    EXPECT_EQ(shipped_map(name).view().width_m(), 40.0);
    EXPECT_EQ(shipped_map(name).view().height_m(), 40.0);
  }
}

TEST(ShippedFiles, TheCourtyardHasEveryClass) {
  std::array<int, kClasses> pixels{};
  for (const SemanticClass c : shipped_map("courtyard").pixels) {
    ++pixels[static_cast<std::size_t>(c)];
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    EXPECT_GT(pixels[i], 256) << name_of(static_cast<SemanticClass>(i)) << " covers less than a square metre";
  }
}

// The terrace lies above y = 24.5 m in the east; the stairs lead to it.
TEST(ShippedFiles, ThePersonGoesEverywhereInTheCourtyardAndTheRobotEverywhereButUpTheStairs) {
  const MapFile courtyard = shipped_map("courtyard");
  const planner::SegmentedMap view = courtyard.view();
  const auto person = reachable(view, AgentKind::kPerson, {10.5, 5.4}, 0.40);
  const auto robot = reachable(view, AgentKind::kRobot, {10.5, 10.0}, 0.40);
  EXPECT_EQ(out_of_sight(view, person, 2.5), 0);
  const auto at = [&](Point p) {
    return static_cast<std::size_t>(p.y_m / view.resolution_m) * static_cast<std::size_t>(view.width_px) +
           static_cast<std::size_t>(p.x_m / view.resolution_m);
  };
  EXPECT_TRUE(person[at({16.5, 25.5})]);
  EXPECT_FALSE(robot[at({16.5, 25.5})]);
  for (std::size_t i = 0; i < person.size(); ++i) {
    const double y_m = static_cast<double>(i / static_cast<std::size_t>(view.width_px)) * view.resolution_m;
    if (person[i] && !robot[i] && courtyard.pixels[i] != kStairs) {
      ASSERT_GE(y_m, 24.4) << "the robot cannot go where the person can";
    }
  }
}

TEST(ShippedFiles, EveryPlaceOfM2IsInReachOfBoth) {
  const MapFile m2 = shipped_map("m2");
  EXPECT_EQ(out_of_sight(m2.view(), reachable(m2.view(), AgentKind::kRobot, {1.75, 1.75}, 0.7), 2.5), 0);
  EXPECT_EQ(out_of_sight(m2.view(), reachable(m2.view(), AgentKind::kPerson, {38.0, 1.75}, 0.7), 2.5), 0);
}

TEST(ShippedFiles, MapsAreWhatTheirProgramDraws) {
  if (std::system("python3 -c 'import tomllib' 2>/dev/null") != 0) {
    GTEST_SKIP() << "no python3 of 3.11 or later";
  }
  EXPECT_EQ(std::system(("'" IVO_SOURCE_DIR "/toolchain/maps/draw' --check")), 0);
}

}  // namespace
}  // namespace ivo::firmware
