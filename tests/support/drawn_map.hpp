// A segmented map drawn in a test: pavement, and what is put on it.
#pragma once

#include <vector>

#include "planner/world/segmented_map.hpp"

namespace ivo::test {

class DrawnMap {
 public:
  DrawnMap(double width_m, double height_m, double resolution_m)
      : width_px_(static_cast<int>(width_m / resolution_m + 0.5)),
        height_px_(static_cast<int>(height_m / resolution_m + 0.5)),
        resolution_m_(resolution_m),
        pixels_(static_cast<std::size_t>(width_px_ * height_px_), SemanticClass::kPavement) {}

  /// Every pixel whose centre lies in the rectangle.
  DrawnMap& put(SemanticClass c, double x0_m, double y0_m, double x1_m, double y1_m) {
    for (int row = 0; row < height_px_; ++row) {
      for (int column = 0; column < width_px_; ++column) {
        const double x = (column + 0.5) * resolution_m_;
        const double y = (row + 0.5) * resolution_m_;
        if (x > x0_m && x < x1_m && y > y0_m && y < y1_m) {
          pixels_[static_cast<std::size_t>(row * width_px_ + column)] = c;
        }
      }
    }
    return *this;
  }

  [[nodiscard]] planner::SegmentedMap view() const {
    return {pixels_, width_px_, height_px_, resolution_m_, default_class_table()};
  }

 private:
  int width_px_;
  int height_px_;
  double resolution_m_;
  std::vector<SemanticClass> pixels_;
};

}  // namespace ivo::test
