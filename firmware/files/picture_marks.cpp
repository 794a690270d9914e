#include "firmware/files/picture_marks.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace ivo::firmware {
namespace {

constexpr Tint kBlack = {0.10, 0.10, 0.12};
constexpr Tint kGold = {1.00, 0.82, 0.10};

std::vector<Point> arrow(Mark mark, double size) {
  constexpr Point kShape[] = {{1.0, 0.0}, {-0.7, 0.72}, {-0.35, 0.0}, {-0.7, -0.72}};
  const double c = std::cos(mark.heading_rad) * size;
  const double s = std::sin(mark.heading_rad) * size;
  std::vector<Point> corners;
  for (const Point p : kShape) {
    corners.push_back({mark.at.x_m + p.x_m * c - p.y_m * s, mark.at.y_m + p.x_m * s + p.y_m * c});
  }
  return corners;
}

/// Which may take several bytes of UTF-8.
std::string first_letter(const std::string& name) {
  std::size_t end = 1;
  while (end < name.size() && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) {
    ++end;
  }
  return name.substr(0, end);
}

}  // namespace

std::vector<Point> rectangle(const Box& b) {
  return {{b.x, b.y}, {b.x + b.width, b.y}, {b.x + b.width, b.y + b.height}, {b.x, b.y + b.height}};
}

void draw_plan_ground(Pen& pen, const std::vector<Point>& line) { pen.line(line, {faded(kWhite, 0.75), 7.0}); }

void draw_plan(Pen& pen, const std::vector<Point>& line, Tint tint, double arrow_spacing) {
  pen.line(line, {tint, 3.4});
  for (const Mark& mark : arrows_along(line, arrow_spacing, 12.0)) {
    const std::vector<Point> corners = arrow(mark, 10.5);
    pen.outline(corners, {faded(kWhite, 0.9), 2.4});
    pen.area(corners, tint);
  }
}

void draw_track(Pen& pen, const std::vector<Point>& line, Tint tint) {
  pen.line(line, {mixed(tint, kBlack, 0.55), 2.0, 9, 5, false});
}

void draw_area_outline(Pen& pen, const std::vector<Point>& corners, Tint tint) {
  pen.outline(corners, {faded(tint, 0.75), 2.6, 2, 6});
}

void draw_restricted(Pen& pen, const std::vector<Point>& corners, Tint tint) {
  pen.hatch(std::array{corners}, {faded(tint, 0.5), 1.4, 0, 0, false}, 13.0);
  pen.outline(corners, {faded(tint, 0.85), 2.2});
}

void draw_out_of_sight(Pen& pen, std::span<const std::vector<Point>> areas) {
  pen.hatch(areas, {faded(kBlack, 0.38), 1.0, 0, 0, false}, 6.5);
}

void draw_stand(Pen& pen, Point centre, Tint tint) {
  pen.disc(centre, 6.0, kWhite);
  pen.ring(centre, 6.0, {tint, 3.0});
}

void draw_sight(Pen& pen, Point centre, double radius, Tint tint) {
  pen.disc(centre, radius, faded(tint, 0.13));
  pen.ring(centre, radius, {faded(tint, 0.9), 2.2});
}

void draw_star(Pen& pen, Point centre, double radius) {
  std::vector<Point> corners;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? radius : 0.45 * radius;
    const double angle = 2 * std::numbers::pi * (i / 10.0 - 0.25);
    corners.push_back({centre.x_m + r * std::cos(angle), centre.y_m + r * std::sin(angle)});
  }
  pen.outline(corners, {kWhite, 7.0});
  pen.outline(corners, {kBlack, 3.4});
  pen.area(corners, kGold);
}

void draw_badge(Pen& pen, Point centre, Tint tint, const std::string& name) {
  pen.disc(centre, 15.0, tint);
  pen.ring(centre, 15.0, {kWhite, 2.6});
  pen.centred_text(first_letter(name), centre, {kWhite, 17, true});
}

}  // namespace ivo::firmware
