#include "config/simple_polygon.hpp"

#include <algorithm>

namespace ivo {
namespace {

// Sign of the turn from a over b to c: 1 left, -1 right, 0 straight.
int turn(Point a, Point b, Point c) {
  const double cross = (b.x_m - a.x_m) * (c.y_m - a.y_m) - (b.y_m - a.y_m) * (c.x_m - a.x_m);
  return cross > 0 ? 1 : cross < 0 ? -1 : 0;
}

// `p` on the line of a and b, between them.
bool between(Point a, Point b, Point p) {
  return turn(a, b, p) == 0 && std::min(a.x_m, b.x_m) <= p.x_m && p.x_m <= std::max(a.x_m, b.x_m) &&
         std::min(a.y_m, b.y_m) <= p.y_m && p.y_m <= std::max(a.y_m, b.y_m);
}

bool meet(Point a, Point b, Point c, Point d) {
  return (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) || between(a, b, c) ||
         between(a, b, d) || between(c, d, a) || between(c, d, b);
}

bool on_one_line(std::span<const Point> polygon) {
  return std::all_of(polygon.begin(), polygon.end(), [&](Point p) { return turn(polygon[0], polygon[1], p) == 0; });
}

}  // namespace

PolygonVerdict judge_polygon(std::span<const Point> polygon) noexcept {
  const std::size_t n = polygon.size();
  if (n < 3) {
    return {PolygonFault::kTooFew};
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (polygon[i] == polygon[(i + 1) % n]) {
      return {PolygonFault::kTwice, i, (i + 1) % n};
    }
  }
  if (on_one_line(polygon)) {
    return {PolygonFault::kNoArea};
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = polygon[i];
    const Point b = polygon[(i + 1) % n];
    // A side and the next share a vertex and meet elsewhere only when one folds back over the other.
    const Point after = polygon[(i + 2) % n];
    bool crosses = between(a, b, after) || between(b, after, a);
    std::size_t other = (i + 1) % n;
    for (std::size_t j = i + 2; j < n && !crosses; ++j) {
      const bool neighbours = (j + 1) % n == i;
      crosses = !neighbours && meet(a, b, polygon[j], polygon[(j + 1) % n]);
      other = j;
    }
    if (crosses) {
      return {PolygonFault::kCrosses, i, other};
    }
  }
  return {};
}

}  // namespace ivo
