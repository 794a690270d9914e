// The object that is looked for, where the product knows its place: drawn from the prior, or given.
#pragma once

#include <cstdint>
#include <optional>

#include "config/mission.hpp"
#include "planner/search/belief.hpp"
#include "planner/world/cells.hpp"

namespace ivo::firmware {

class SearchObject {
 public:
  /// An object whose place nobody knows: never found by rule.
  SearchObject() = default;
  SearchObject(Point place, FindRule rule) noexcept : place_(place), rule_(rule) {}

  /// Drawn from the prior over the observable cells: the centre of a cell. The same seed, the same place.
  [[nodiscard]] static SearchObject drawn(const planner::Cells& cells, const planner::Belief& belief,
                                          std::uint64_t seed, FindRule rule) noexcept;

  [[nodiscard]] std::optional<Point> place() const noexcept { return place_; }

  /// Whether somebody at `from` finds it: within `radius_m`, and in sight unless distance alone decides. Cost: one line
  /// of sight.
  [[nodiscard]] bool found_from(const planner::Cells& cells, Point from, double radius_m) const noexcept;

 private:
  std::optional<Point> place_;
  FindRule rule_ = FindRule::kSight;
};

}  // namespace ivo::firmware
