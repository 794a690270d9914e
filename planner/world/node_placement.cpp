#include "planner/world/node_placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ivo::planner {
namespace {

double overlap(double low, double high, double pixel_low, double size) noexcept {
  return std::max(0.0, std::min(high, pixel_low + size) - std::max(low, pixel_low));
}

// The free area is what no obstacle pixel covers; pixels that the square's sides cut count by the part inside.
std::optional<Point> free_centroid(const SegmentedMap& map, const Square& square) noexcept {
  const double size = map.resolution_m;
  const int first_row = std::max(0, static_cast<int>(square.min_y_m / size));
  const int last_row = std::min(map.height_px - 1, static_cast<int>(square.max_y_m / size));
  const int first_column = std::max(0, static_cast<int>(square.min_x_m / size));
  const int last_column = std::min(map.width_px - 1, static_cast<int>(square.max_x_m / size));
  double area = 0.0;
  double moment_x = 0.0;
  double moment_y = 0.0;
  for (int row = first_row; row <= last_row; ++row) {
    const double height = overlap(square.min_y_m, square.max_y_m, row * size, size);
    const double y = 0.5 * (std::max(square.min_y_m, row * size) + std::min(square.max_y_m, (row + 1) * size));
    for (int column = first_column; column <= last_column; ++column) {
      if (map.obstacle(column, row)) {
        continue;
      }
      const double part = height * overlap(square.min_x_m, square.max_x_m, column * size, size);
      area += part;
      moment_x +=
          part * 0.5 * (std::max(square.min_x_m, column * size) + std::min(square.max_x_m, (column + 1) * size));
      moment_y += part * y;
    }
  }
  if (area <= 0.0) {
    return std::nullopt;
  }
  return Point{moment_x / area, moment_y / area};
}

}  // namespace

std::optional<Point> place_node(const SegmentedMap& map, const Square& square, double clearance_m) noexcept {
  const ClassSet obstacles = obstacle_classes(map.classes);
  constexpr double kRounding = 1e-9;  // a node exactly at the clearance is clear; corners equally far are a tie
  const auto clear = [&](Point p) { return clearance(map, obstacles, p, clearance_m) >= clearance_m - kRounding; };
  const Point centre{0.5 * (square.min_x_m + square.max_x_m), 0.5 * (square.min_y_m + square.max_y_m)};
  if (clear(centre)) {
    return centre;
  }
  const std::optional<Point> centroid = free_centroid(map, square);
  if (!centroid) {
    return std::nullopt;
  }
  if (clear(*centroid)) {
    return centroid;
  }
  const std::array<Point, 4> corners = {
      {{square.min_x_m, square.min_y_m},
       {square.max_x_m, square.min_y_m},
       {square.min_x_m, square.max_y_m},
       {square.max_x_m, square.max_y_m}}};  // lower first, then left: the order of ties
  std::optional<Point> nearest;
  double nearest_m = 0.0;
  for (const Point corner : corners) {
    const double dx = corner.x_m - centroid->x_m;
    const double dy = corner.y_m - centroid->y_m;
    const double distance_m = std::sqrt(dx * dx + dy * dy);
    if ((!nearest || distance_m < nearest_m - kRounding) && clear(corner)) {
      nearest = corner;
      nearest_m = distance_m;
    }
  }
  return nearest;
}

}  // namespace ivo::planner
