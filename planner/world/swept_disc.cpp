#include <ccd/ccd.h>
#include <ccd/quat.h>

#include <algorithm>
#include <cmath>

#include "planner/world/collision.hpp"

namespace ivo::planner {
namespace {

// libccd works in space: every shape stands one metre high around z = 0, so that only the plane decides.
constexpr double kHalfHeight = 0.5;

struct Capsule {
  Point a;
  Point b;
  double radius_m = 0.0;
};

struct Box {
  double min_x, min_y, max_x, max_y;
};

void support_capsule(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* support) {
  const auto& capsule = *static_cast<const Capsule*>(object);
  const double x = ccdVec3X(direction);
  const double y = ccdVec3Y(direction);
  const double length = std::sqrt(x * x + y * y);
  const double along = x * (capsule.b.x_m - capsule.a.x_m) + y * (capsule.b.y_m - capsule.a.y_m);
  const Point end = along > 0 ? capsule.b : capsule.a;
  const double scale = length > 0 ? capsule.radius_m / length : 0.0;
  ccdVec3Set(support, end.x_m + x * scale, end.y_m + y * scale, ccdVec3Z(direction) > 0 ? kHalfHeight : -kHalfHeight);
}

void centre_capsule(const void* object, ccd_vec3_t* centre) {
  const auto& capsule = *static_cast<const Capsule*>(object);
  ccdVec3Set(centre, 0.5 * (capsule.a.x_m + capsule.b.x_m), 0.5 * (capsule.a.y_m + capsule.b.y_m), 0);
}

void support_box(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* support) {
  const auto& box = *static_cast<const Box*>(object);
  ccdVec3Set(support, ccdVec3X(direction) > 0 ? box.max_x : box.min_x, ccdVec3Y(direction) > 0 ? box.max_y : box.min_y,
             ccdVec3Z(direction) > 0 ? kHalfHeight : -kHalfHeight);
}

void centre_box(const void* object, ccd_vec3_t* centre) {
  const auto& box = *static_cast<const Box*>(object);
  ccdVec3Set(centre, 0.5 * (box.min_x + box.max_x), 0.5 * (box.min_y + box.max_y), 0);
}

bool intersect(const Capsule& capsule, const Box& box) noexcept {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support_capsule;
  ccd.support2 = support_box;
  ccd.center1 = centre_capsule;
  ccd.center2 = centre_box;
  return ccdMPRIntersect(&capsule, &box, &ccd) != 0;
}

// The x that the capsule may reach between the lines y = low and y = high: the segment there, widened by the radius.
struct Interval {
  double low, high;
};
Interval reach_between(const Capsule& capsule, double low, double high) noexcept {
  const double dy = capsule.b.y_m - capsule.a.y_m;
  double from = 0.0;
  double to = 1.0;
  if (dy != 0.0) {
    const double t1 = (low - capsule.radius_m - capsule.a.y_m) / dy;
    const double t2 = (high + capsule.radius_m - capsule.a.y_m) / dy;
    from = std::clamp(std::min(t1, t2), 0.0, 1.0);
    to = std::clamp(std::max(t1, t2), 0.0, 1.0);
  }
  const double x1 = capsule.a.x_m + (capsule.b.x_m - capsule.a.x_m) * from;
  const double x2 = capsule.a.x_m + (capsule.b.x_m - capsule.a.x_m) * to;
  return {std::min(x1, x2) - capsule.radius_m, std::max(x1, x2) + capsule.radius_m};
}

}  // namespace

bool swept_disc_is_free(const SegmentedMap& map, ClassSet blocked, Point a, Point b, double radius_m) noexcept {
  if (!inside_border(map, a, radius_m) || !inside_border(map, b, radius_m)) {
    return false;
  }
  const Capsule capsule{a, b, radius_m};
  const double size = map.resolution_m;
  const int first_row = std::max(0, static_cast<int>((std::min(a.y_m, b.y_m) - radius_m) / size));
  const int last_row = std::min(map.height_px - 1, static_cast<int>((std::max(a.y_m, b.y_m) + radius_m) / size));
  for (int row = first_row; row <= last_row; ++row) {
    const Interval reach = reach_between(capsule, row * size, (row + 1) * size);
    const int first_column = std::max(0, static_cast<int>(reach.low / size));
    const int last_column = std::min(map.width_px - 1, static_cast<int>(reach.high / size));
    for (int column = first_column; column <= last_column; ++column) {
      if (!holds(blocked, map.at(column, row))) {
        continue;
      }
      const int run_start = column;
      while (column < last_column && holds(blocked, map.at(column + 1, row))) {
        ++column;
      }
      if (intersect(capsule, {run_start * size, row * size, (column + 1) * size, (row + 1) * size})) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace ivo::planner
