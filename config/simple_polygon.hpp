// Is a drawn border the border of one area?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "config/base/geometry.hpp"

namespace ivo {

enum class PolygonFault : std::uint8_t {
  kNone,
  kTooFew,   ///< fewer than three vertices
  kTwice,    ///< vertices `first` and `second` are the same
  kNoArea,   ///< all on one line
  kCrosses,  ///< sides `first` and `second` meet; side i goes from vertex i to the next
};

struct PolygonVerdict {
  PolygonFault fault = PolygonFault::kNone;
  std::size_t first = 0;
  std::size_t second = 0;
};

/// Of a closed polygon, the first vertex not repeated; numbers are finite. Cost: the square of the vertices.
[[nodiscard]] PolygonVerdict judge_polygon(std::span<const Point> polygon) noexcept;

}  // namespace ivo
