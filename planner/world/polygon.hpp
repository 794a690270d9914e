// Areas drawn on the map: restricted and preferred.
#pragma once

#include "config/base/geometry.hpp"
#include "config/base/static_vector.hpp"
#include "config/limits.hpp"

namespace ivo::planner {

/// A simple polygon, first vertex not repeated.
using Area = StaticVector<Point, limits::kPolygonVertices>;
using Areas = StaticVector<Area, limits::kAreas>;

/// Even-odd rule; of a shared border each point lies in one of the two. Cost: the vertices.
[[nodiscard]] bool contains(const Area& area, Point p) noexcept;
[[nodiscard]] bool contains(const Areas& areas, Point p) noexcept;

/// True when the segment has a point inside the area or crosses its border. Cost: the vertices.
[[nodiscard]] bool touches(const Area& area, Point a, Point b) noexcept;
[[nodiscard]] bool touches(const Areas& areas, Point a, Point b) noexcept;

}  // namespace ivo::planner
