#include "config/semantic_class.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <vector>

namespace ivo {
namespace {

using enum SemanticClass;

std::vector<SemanticClass> all_classes() {
  std::vector<SemanticClass> all;
  for (int i = 0; i < kClasses; ++i) {
    all.push_back(static_cast<SemanticClass>(i));
  }
  return all;
}

TEST(SemanticClass, EveryNameNamesItsClass) {
  std::set<std::string_view> names;
  for (const SemanticClass c : all_classes()) {
    EXPECT_EQ(class_named(name_of(c)), c) << name_of(c);
    names.insert(name_of(c));
  }
  EXPECT_EQ(names.size(), 14U);
}

TEST(SemanticClass, FilesSpellTheNamesWithBlanks) {
  EXPECT_EQ(name_of(kCycleLane), "cycle lane");
  EXPECT_EQ(name_of(kStreetFurniture), "street furniture");
  EXPECT_EQ(name_of(kPavement), "pavement");
  EXPECT_EQ(name_of(kStairs), "stairs");
}

TEST(SemanticClass, AnUnknownNameIsNoClass) {
  for (const std::string_view name : {"", "lava", "Pavement", "cycle_lane", "pavement "}) {
    EXPECT_FALSE(class_named(name).has_value()) << name;
  }
}

TEST(SemanticClass, TheDefaultsAreThoseOfTheModel) {
  const std::set<SemanticClass> obstacles = {kBuilding, kWall, kTree, kShrub, kStreetFurniture, kWater};
  const std::set<SemanticClass> occluders = {kBuilding, kWall, kTree, kShrub};
  const ClassTable table = default_class_table();
  for (const SemanticClass c : all_classes()) {
    const ClassProperties& properties = table[static_cast<std::size_t>(c)];
    EXPECT_EQ(properties.obstacle, obstacles.count(c) == 1) << name_of(c);
    EXPECT_EQ(properties.occluder, occluders.count(c) == 1) << name_of(c);
    EXPECT_EQ(properties.restricted[static_cast<std::size_t>(AgentKind::kRobot)], c == kStairs) << name_of(c);
    EXPECT_FALSE(properties.restricted[static_cast<std::size_t>(AgentKind::kPerson)]) << name_of(c);
  }
}

TEST(SemanticClass, NoTwoClassesShareAColour) {
  const ClassTable table = default_class_table();
  for (std::size_t a = 0; a < table.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_FALSE(table[a].colour == table[b].colour) << a << " and " << b;
    }
  }
}

}  // namespace
}  // namespace ivo
