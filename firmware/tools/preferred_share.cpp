#include "firmware/tools/preferred_share.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ivo::firmware {
namespace {

Point along(Point a, Point b, double share) {
  return {a.x_m + (b.x_m - a.x_m) * share, a.y_m + (b.y_m - a.y_m) * share};
}

double cross(Point a, Point b) { return a.x_m * b.y_m - a.y_m * b.x_m; }

/// Where, as shares of it, the segment crosses the border of an area; 0 and 1 too, sorted.
std::vector<double> cuts(Point a, Point b, const planner::Areas& areas) {
  std::vector<double> cuts = {0.0, 1.0};
  const Point d{b.x_m - a.x_m, b.y_m - a.y_m};
  for (const planner::Area& area : areas) {
    for (std::size_t i = 0; i < area.size(); ++i) {
      const Point p = area[i];
      const Point q = area[(i + 1) % area.size()];
      const Point side{q.x_m - p.x_m, q.y_m - p.y_m};
      const double determinant = cross(d, side);
      if (determinant == 0.0) {
        continue;  // parallel: it crosses the neighbouring sides, if any
      }
      const double share = cross({p.x_m - a.x_m, p.y_m - a.y_m}, side) / determinant;
      if (share > 0.0 && share < 1.0) {
        cuts.push_back(share);
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace

double share_inside(std::span<const Point> way, double length_m, const planner::Areas& areas) {
  double left_m = length_m;
  double inside_m = 0.0;
  for (std::size_t i = 1; i < way.size() && left_m > 0.0; ++i) {
    const Point a = way[i - 1];
    Point b = way[i];
    double segment_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    if (segment_m > left_m) {
      b = along(a, b, left_m / segment_m);
      segment_m = left_m;
    }
    const std::vector<double> at = cuts(a, b, areas);
    for (std::size_t k = 1; k < at.size(); ++k) {
      if (planner::contains(areas, along(a, b, 0.5 * (at[k - 1] + at[k])))) {
        inside_m += (at[k] - at[k - 1]) * segment_m;
      }
    }
    left_m -= segment_m;
  }
  return length_m > 0.0 ? std::min(1.0, inside_m / length_m) : 0.0;
}

}  // namespace ivo::firmware
