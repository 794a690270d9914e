// A segmented top view: one of 14 classes a pixel (model.md, "World"). A view: the pixels belong to who read the file.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "config/base/contract.hpp"
#include "config/base/geometry.hpp"
#include "config/semantic_class.hpp"

namespace ivo::planner {

struct SegmentedMap {
  std::span<const SemanticClass>
      pixels;  ///< row by row, the bottom row first: pixel (0, 0) has its lower-left corner at (0, 0)
  int width_px = 0;
  int height_px = 0;
  double resolution_m = 0.0;  ///< side of a pixel
  ClassTable classes{};

  [[nodiscard]] double width_m() const noexcept { return width_px * resolution_m; }
  [[nodiscard]] double height_m() const noexcept { return height_px * resolution_m; }
  [[nodiscard]] SemanticClass at(int column, int row) const noexcept {
    IVO_CONTRACT(column >= 0 && column < width_px && row >= 0 && row < height_px);
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(column)];
  }
  [[nodiscard]] const ClassProperties& properties(SemanticClass c) const noexcept {
    return classes[static_cast<std::size_t>(c)];
  }
  [[nodiscard]] bool obstacle(int column, int row) const noexcept { return properties(at(column, row)).obstacle; }
  [[nodiscard]] bool contains(Point p) const noexcept {
    return p.x_m >= 0 && p.y_m >= 0 && p.x_m < width_m() && p.y_m < height_m();
  }
};

}  // namespace ivo::planner
