// Parallel lanes over the map, cut where an agent's footprint does not fit: what a lawnmower goes along.
#pragma once

#include <vector>

#include "firmware/tools/bench/rivals/free_ways.hpp"

namespace ivo::firmware::rivals {

struct LaneSetting {
  bool along_x = false;  ///< else along y
  double swath_m = 5.0;  ///< between lanes
  double first_m = 2.5;  ///< of the first lane from the lower or left border
  friend bool operator==(const LaneSetting&, const LaneSetting&) = default;
};

/// Free pieces of one lane, from its lower or left end.
struct LanePiece {
  Point from;
  Point to;
};
using Lane = std::vector<LanePiece>;

/// Lanes from the lower or left border on. Cost: a swept-disc test each half a metre.
[[nodiscard]] std::vector<Lane> lanes(const FreeWays& ways, const planner::SegmentedMap& map,
                                      const LaneSetting& setting);

/// Pieces that end `gap_m` before what stops them; one shorter than two gaps is its middle.
[[nodiscard]] Lane shortened(Lane lane, double gap_m);

[[nodiscard]] double length_m(const Lane& lane);

}  // namespace ivo::firmware::rivals
