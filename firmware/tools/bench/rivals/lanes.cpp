#include "firmware/tools/bench/rivals/lanes.hpp"

#include <algorithm>
#include <cmath>

namespace ivo::firmware::rivals {
std::vector<Lane> lanes(const FreeWays& ways, const planner::SegmentedMap& map, const LaneSetting& setting) {
  constexpr double kStepM = 0.5;
  const double across_m = setting.along_x ? map.height_m() : map.width_m();
  const double along_m = setting.along_x ? map.width_m() : map.height_m();
  const int steps = std::max(1, static_cast<int>(along_m / kStepM));
  std::vector<Lane> all;
  for (double at_m = setting.first_m; at_m < across_m; at_m += setting.swath_m) {
    const auto point = [&](int step) {
      // Half a step from the border: nobody's centre gets closer.
      const double t = along_m * (step + 0.5) / steps;
      return setting.along_x ? Point{t, at_m} : Point{at_m, t};
    };
    Lane lane;
    bool in_piece = false;
    for (int step = 0; step < steps; ++step) {
      const Point here = point(step);
      if (in_piece && ways.straight(lane.back().to, here)) {
        lane.back().to = here;
        continue;
      }
      in_piece = ways.straight(here, here);
      if (in_piece) {
        lane.push_back({here, here});
      }
    }
    all.push_back(std::move(lane));
  }
  return all;
}

Lane shortened(Lane lane, double gap_m) {
  for (LanePiece& piece : lane) {
    const double dx = piece.to.x_m - piece.from.x_m;
    const double dy = piece.to.y_m - piece.from.y_m;
    const double length = std::hypot(dx, dy);
    const double share = length > 0.0 ? std::min(0.5, gap_m / length) : 0.0;
    piece = {{piece.from.x_m + dx * share, piece.from.y_m + dy * share},
             {piece.to.x_m - dx * share, piece.to.y_m - dy * share}};
  }
  return lane;
}

double length_m(const Lane& lane) {
  double sum_m = 0.0;
  for (const LanePiece& piece : lane) {
    sum_m += std::hypot(piece.to.x_m - piece.from.x_m, piece.to.y_m - piece.from.y_m);
  }
  return sum_m;
}

}  // namespace ivo::firmware::rivals
