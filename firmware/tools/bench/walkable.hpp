// The largest connected place of a map where somebody can stand: where the benches put agents on maps of others.
#pragma once

#include <vector>

#include "planner/world/segmented_map.hpp"

namespace ivo::firmware::bench {

class Walkable {
 public:
  /// Pixel centres that are `clearance_m` from every obstacle, joined side by side. Cost: the pixels times those around
  /// each.
  Walkable(const planner::SegmentedMap& map, double clearance_m);

  /// The place's pixel centre nearest to `p`; `p` when there is no such place.
  [[nodiscard]] Point nearest(Point p) const;

 private:
  std::vector<Point> places_;
};

}  // namespace ivo::firmware::bench
