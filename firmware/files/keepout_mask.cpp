#include "firmware/files/keepout_mask.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "config/base/contract.hpp"
#include "config/limits.hpp"
#include "firmware/files/number_text.hpp"
#include "planner/world/polygon.hpp"

namespace ivo::firmware {
namespace {

constexpr char kKeptOut = 0;
constexpr char kFree = static_cast<char>(254);

/// Of the pixels between two coordinates, no less: first and behind the last.
std::pair<int, int> pixel_range(double from_m, double to_m, double resolution_m, int pixels) {
  const double most = pixels;
  return {static_cast<int>(std::clamp(std::floor(from_m / resolution_m), 0.0, most)),
          static_cast<int>(std::clamp(std::ceil(to_m / resolution_m), 0.0, most))};
}

}  // namespace

std::string pixels_within(int width_px, int height_px, double resolution_m, std::span<const Polygon> areas) {
  std::string pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), '\0');
  for (const Polygon& polygon : areas) {
    if (polygon.size() < 3 || polygon.size() > limits::kPolygonVertices) {
      continue;
    }
    planner::Area area;
    for (const Point corner : polygon) {
      (void)area.push_back(corner);
    }
    // The planner's own question at every centre, so that mask and plan agree; only the area's box is asked.
    const auto [left, right] = std::minmax_element(polygon.begin(), polygon.end(),
                                                   [](const Point& a, const Point& b) { return a.x_m < b.x_m; });
    const auto [bottom, top] = std::minmax_element(polygon.begin(), polygon.end(),
                                                   [](const Point& a, const Point& b) { return a.y_m < b.y_m; });
    const auto [column, columns] = pixel_range(left->x_m, right->x_m, resolution_m, width_px);
    const auto [first_row, rows] = pixel_range(bottom->y_m, top->y_m, resolution_m, height_px);
    for (int y = first_row; y < rows; ++y) {
      for (int x = column; x < columns; ++x) {
        if (planner::contains(area, Point{(x + 0.5) * resolution_m, (y + 0.5) * resolution_m})) {
          pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x)] = 1;
        }
      }
    }
  }
  return pixels;
}

KeepoutMask keepout_mask(const MaskedMap& map, const std::string& image) {
  const std::string within = pixels_within(map.width_px, map.height_px, map.resolution_m, map.no_go);
  IVO_CONTRACT(map.obstacles.empty() || map.obstacles.size() == within.size());
  KeepoutMask mask;
  mask.pgm = "P5\n" + std::to_string(map.width_px) + " " + std::to_string(map.height_px) + "\n255\n";
  const auto width = static_cast<std::size_t>(map.width_px);
  for (int row = map.height_px - 1; row >= 0; --row) {
    for (std::size_t i = static_cast<std::size_t>(row) * width; i < (static_cast<std::size_t>(row) + 1) * width; ++i) {
      const bool out = within[i] != 0 || (!map.obstacles.empty() && map.obstacles[i] != 0);
      mask.pgm += out ? kKeptOut : kFree;
    }
  }
  mask.yaml = "image: " + image + "\nmode: trinary\nresolution: " + shortest(map.resolution_m) + "\norigin: [" +
              shortest(map.origin_m.x_m) + ", " + shortest(map.origin_m.y_m) +
              ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  return mask;
}

}  // namespace ivo::firmware
