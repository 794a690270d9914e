#include "firmware/tools/dialogue/path_place.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ivo::firmware {

double along_path(std::span<const Point> path, Point at, double before_m) noexcept {
  constexpr double kBack_m = 0.5;
  double nearest_m = std::numeric_limits<double>::infinity();
  double along_m = before_m;
  double begin_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point a = path[i - 1];
    const Point b = path[i];
    const double length_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    const double low = std::max(0.0, before_m - kBack_m - begin_m);
    const double high = std::min(length_m, before_m + kAhead_m - begin_m);
    if (length_m > 0.0 && low <= high) {
      const double foot = ((at.x_m - a.x_m) * (b.x_m - a.x_m) + (at.y_m - a.y_m) * (b.y_m - a.y_m)) / length_m;
      const double s = std::clamp(foot, low, high);
      const double x_m = a.x_m + (b.x_m - a.x_m) * s / length_m;
      const double y_m = a.y_m + (b.y_m - a.y_m) * s / length_m;
      const double away_m = std::hypot(at.x_m - x_m, at.y_m - y_m);
      if (away_m < nearest_m) {
        nearest_m = away_m;
        along_m = begin_m + s;
      }
    }
    begin_m += length_m;
  }
  return std::max(before_m, along_m);
}

}  // namespace ivo::firmware
