#include "firmware/tools/bench/walkable.hpp"

#include <algorithm>
#include <cmath>

#include "planner/world/collision.hpp"

namespace ivo::firmware::bench {

Walkable::Walkable(const planner::SegmentedMap& map, double clearance_m) {
  const planner::ClassSet obstacles = planner::obstacle_classes(map.classes);
  const auto centre = [&](int pixel) {
    const int row = pixel / map.width_px;
    const int column = pixel % map.width_px;
    return Point{(column + 0.5) * map.resolution_m, (row + 0.5) * map.resolution_m};
  };
  const int pixels = map.width_px * map.height_px;
  std::vector<bool> open(static_cast<std::size_t>(pixels));
  for (int pixel = 0; pixel < pixels; ++pixel) {
    open[static_cast<std::size_t>(pixel)] =
        planner::clearance(map, obstacles, centre(pixel), clearance_m) >= clearance_m;
  }
  std::vector<int> largest;
  for (int seed = 0; seed < pixels; ++seed) {
    std::vector<int> place;
    const auto visit = [&](int pixel) {
      if (open[static_cast<std::size_t>(pixel)]) {
        open[static_cast<std::size_t>(pixel)] = false;
        place.push_back(pixel);
      }
    };
    visit(seed);
    for (std::size_t next = 0; next < place.size(); ++next) {  // an open pixel never lies at the border
      for (const int step : {-1, 1, -map.width_px, map.width_px}) {
        visit(place[next] + step);
      }
    }
    if (place.size() > largest.size()) {
      largest.swap(place);
    }
  }
  for (const int pixel : largest) {
    places_.push_back(centre(pixel));
  }
}

Point Walkable::nearest(Point p) const {
  const auto closer = [&](Point a, Point b) {
    return std::hypot(a.x_m - p.x_m, a.y_m - p.y_m) < std::hypot(b.x_m - p.x_m, b.y_m - p.y_m);
  };
  const auto found = std::min_element(places_.begin(), places_.end(), closer);
  return found == places_.end() ? p : *found;
}

}  // namespace ivo::firmware::bench
