// The marks that map and legend share, so that the legend shows what is on the map.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "firmware/files/picture_layout.hpp"
#include "firmware/files/picture_pen.hpp"
#include "firmware/files/picture_style.hpp"

namespace ivo::firmware {

inline constexpr Tint kWhite = {1.0, 1.0, 1.0};

[[nodiscard]] std::vector<Point> rectangle(const Box& box);

/// All in pixels.
/// The white under a plan's line; under every plan before any line, so that it hides none.
void draw_plan_ground(Pen& pen, const std::vector<Point>& line);
void draw_plan(Pen& pen, const std::vector<Point>& line, Tint tint, double arrow_spacing);
void draw_track(Pen& pen, const std::vector<Point>& line, Tint tint);
void draw_area_outline(Pen& pen, const std::vector<Point>& corners, Tint tint);
void draw_restricted(Pen& pen, const std::vector<Point>& corners, Tint tint);
void draw_out_of_sight(Pen& pen, std::span<const std::vector<Point>> areas);
/// Where an agent stands.
void draw_stand(Pen& pen, Point centre, Tint tint);
void draw_sight(Pen& pen, Point centre, double radius, Tint tint);
void draw_star(Pen& pen, Point centre, double radius);
/// A disc with the first letter of `name`.
void draw_badge(Pen& pen, Point centre, Tint tint, const std::string& name);

}  // namespace ivo::firmware
