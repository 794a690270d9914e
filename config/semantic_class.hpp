// The 14 classes of a segmented top view (model.md, "World") and what each means for motion and sight.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ivo {

inline constexpr int kClasses = 14;

/// Order is the network's order of input planes and the tie-break of resampling (lowest first).
enum class SemanticClass : std::uint8_t {
  kPavement,
  kRoad,
  kCrossing,
  kParking,
  kCycleLane,
  kGrass,
  kSoil,
  kBuilding,
  kWall,
  kTree,
  kShrub,
  kStreetFurniture,
  kWater,
  kStairs,
};

enum class AgentKind : std::uint8_t { kRobot, kPerson };
inline constexpr int kAgentKinds = 2;

struct Colour {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

struct ClassProperties {
  Colour colour;
  bool obstacle = false;                       ///< blocks motion; holds no probability
  bool occluder = false;                       ///< blocks sight
  std::array<bool, kAgentKinds> restricted{};  ///< by AgentKind: may not be entered
};

/// Names as files spell them: "pavement", "road", "crossing", "parking", "cycle lane", "grass", "soil", "building",
/// "wall", "tree", "shrub", "street furniture", "water", "stairs".
[[nodiscard]] std::string_view name_of(SemanticClass c) noexcept;
[[nodiscard]] std::optional<SemanticClass> class_named(std::string_view name) noexcept;

/// Properties by class. Default: the project's palette and model.md's obstacles, occluders and restrictions.
using ClassTable = std::array<ClassProperties, kClasses>;
[[nodiscard]] ClassTable default_class_table() noexcept;

}  // namespace ivo
