#include "planner/world/polygon.hpp"

#include <algorithm>

namespace ivo::planner {
namespace {

double cross(Point o, Point a, Point b) noexcept {
  return (a.x_m - o.x_m) * (b.y_m - o.y_m) - (a.y_m - o.y_m) * (b.x_m - o.x_m);
}

bool between(double value, double a, double b) noexcept { return value >= std::min(a, b) && value <= std::max(a, b); }

bool on_segment(Point p, Point a, Point b) noexcept {
  return cross(a, b, p) == 0.0 && between(p.x_m, a.x_m, b.x_m) && between(p.y_m, a.y_m, b.y_m);
}

bool segments_meet(Point a, Point b, Point c, Point d) noexcept {
  const double c_side = cross(a, b, c);
  const double d_side = cross(a, b, d);
  const double a_side = cross(c, d, a);
  const double b_side = cross(c, d, b);
  if (((c_side > 0 && d_side < 0) || (c_side < 0 && d_side > 0)) &&
      ((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0))) {
    return true;
  }
  return on_segment(c, a, b) || on_segment(d, a, b) || on_segment(a, c, d) || on_segment(b, c, d);
}

}  // namespace

bool contains(const Area& area, Point p) noexcept {
  bool inside = false;
  for (std::size_t i = 0, j = area.size() - 1; i < area.size(); j = i++) {
    const Point a = area[i];
    const Point b = area[j];
    if ((a.y_m > p.y_m) != (b.y_m > p.y_m) && p.x_m < (b.x_m - a.x_m) * (p.y_m - a.y_m) / (b.y_m - a.y_m) + a.x_m) {
      inside = !inside;
    }
  }
  return inside;
}

bool contains(const Areas& areas, Point p) noexcept {
  return std::any_of(areas.begin(), areas.end(), [&](const Area& area) { return contains(area, p); });
}

bool touches(const Area& area, Point a, Point b) noexcept {
  if (contains(area, a) || contains(area, b)) {
    return true;
  }
  for (std::size_t i = 0, j = area.size() - 1; i < area.size(); j = i++) {
    if (segments_meet(a, b, area[i], area[j])) {
      return true;
    }
  }
  return false;
}

bool touches(const Areas& areas, Point a, Point b) noexcept {
  return std::any_of(areas.begin(), areas.end(), [&](const Area& area) { return touches(area, a, b); });
}

}  // namespace ivo::planner
