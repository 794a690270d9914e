#include "config/semantic_class.hpp"

#include <cstddef>

namespace ivo {
namespace {

constexpr std::array<std::string_view, kClasses> kNames = {
    "pavement", "road", "crossing", "parking", "cycle lane",       "grass", "soil",
    "building", "wall", "tree",     "shrub",   "street furniture", "water", "stairs",
};

constexpr std::array<Colour, kClasses> kPalette = {{
    {214, 210, 202},  // pavement
    {120, 122, 128},  // road
    {240, 240, 235},  // crossing
    {158, 160, 170},  // parking
    {196, 120, 104},  // cycle lane
    {148, 192, 112},  // grass
    {200, 174, 132},  // soil
    {104, 84, 92},    // building
    {60, 56, 60},     // wall
    {46, 110, 62},    // tree
    {92, 148, 84},    // shrub
    {222, 160, 60},   // street furniture
    {96, 156, 204},   // water
    {176, 140, 190},  // stairs
}};

constexpr bool any_of(SemanticClass c, std::initializer_list<SemanticClass> set) noexcept {
  for (const SemanticClass s : set) {
    if (s == c) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string_view name_of(SemanticClass c) noexcept { return kNames[static_cast<std::size_t>(c)]; }

std::optional<SemanticClass> class_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) {
      return static_cast<SemanticClass>(i);
    }
  }
  return std::nullopt;
}

ClassTable default_class_table() noexcept {
  using enum SemanticClass;
  ClassTable table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto c = static_cast<SemanticClass>(i);
    table[i].colour = kPalette[i];
    table[i].obstacle = any_of(c, {kBuilding, kWall, kTree, kShrub, kStreetFurniture, kWater});
    table[i].occluder = any_of(c, {kBuilding, kWall, kTree, kShrub});
    table[i].restricted[static_cast<std::size_t>(AgentKind::kRobot)] = c == kStairs;
  }
  return table;
}

}  // namespace ivo
