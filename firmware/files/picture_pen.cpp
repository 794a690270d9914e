// The only file that includes cairo.
#include "firmware/files/picture_pen.hpp"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ivo::firmware {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct Destroy {
  void operator()(cairo_surface_t* surface) const noexcept { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const noexcept { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Context = std::unique_ptr<cairo_t, Destroy>;

void ink(cairo_t* cr, Tint t) { cairo_set_source_rgba(cr, t.r, t.g, t.b, t.alpha); }

void path(cairo_t* cr, std::span<const Point> points) {
  cairo_new_path(cr);
  for (const Point p : points) {
    cairo_line_to(cr, p.x_m, p.y_m);
  }
}

void draw(cairo_t* cr, const Stroke& stroke) {
  const double pattern[] = {stroke.dash_on, stroke.dash_off};
  cairo_set_dash(cr, pattern, stroke.dash_on > 0 ? 2 : 0, 0);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cr, stroke.round_ends ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  cairo_set_line_width(cr, stroke.width);
  ink(cr, stroke.tint);
  cairo_stroke(cr);
}

void font(cairo_t* cr, const Lettering& lettering) {
  cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         lettering.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, lettering.size);
  ink(cr, lettering.tint);
}

cairo_text_extents_t extents_of(cairo_t* cr, const std::string& words) {
  cairo_text_extents_t extents{};
  cairo_text_extents(cr, words.c_str(), &extents);
  return extents;
}

cairo_status_t append(void* out, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct Pen::Sheet {
  Surface surface;
  Context context;
  [[nodiscard]] cairo_t* cr() const { return context.get(); }
};

std::uint32_t premultiplied(Tint t) {
  const auto level = [](double v) { return static_cast<std::uint32_t>(std::lround(255.0 * v)); };
  return level(t.alpha) << 24 | level(t.r * t.alpha) << 16 | level(t.g * t.alpha) << 8 | level(t.b * t.alpha);
}

Pen::Pen(int width_px, int height_px, Tint paper) : sheet_(std::make_unique<Sheet>()) {
  sheet_->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px));
  sheet_->context.reset(cairo_create(sheet_->surface.get()));
  ink(sheet_->cr(), paper);
  cairo_paint(sheet_->cr());
}

Pen::~Pen() = default;

bool Pen::ok() const { return cairo_status(sheet_->cr()) == CAIRO_STATUS_SUCCESS; }

void Pen::clip(const Box& box) {
  cairo_save(sheet_->cr());
  cairo_new_path(sheet_->cr());
  cairo_rectangle(sheet_->cr(), box.x, box.y, box.width, box.height);
  cairo_clip(sheet_->cr());
}

void Pen::unclip() { cairo_restore(sheet_->cr()); }

void Pen::line(std::span<const Point> points, const Stroke& stroke) {
  path(sheet_->cr(), points);
  draw(sheet_->cr(), stroke);
}

void Pen::outline(std::span<const Point> corners, const Stroke& stroke) {
  path(sheet_->cr(), corners);
  cairo_close_path(sheet_->cr());
  draw(sheet_->cr(), stroke);
}

void Pen::area(std::span<const Point> corners, Tint tint) {
  path(sheet_->cr(), corners);
  ink(sheet_->cr(), tint);
  cairo_fill(sheet_->cr());
}

void Pen::hatch(std::span<const std::vector<Point>> areas, const Stroke& stroke, double spacing) {
  cairo_t* const cr = sheet_->cr();
  cairo_save(cr);
  cairo_new_path(cr);
  for (const std::vector<Point>& corners : areas) {
    cairo_new_sub_path(cr);
    for (const Point p : corners) {
      cairo_line_to(cr, p.x_m, p.y_m);
    }
    cairo_close_path(cr);
  }
  // With soft edges, seams between touching areas would show.
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
  cairo_clip(cr);
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_DEFAULT);
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;
  cairo_clip_extents(cr, &left, &top, &right, &bottom);
  cairo_new_path(cr);
  // Lines x + y = a multiple of the spacing, whatever the areas: neighbours' lines meet.
  for (double sum = std::ceil((left + top) / spacing) * spacing; sum < right + bottom; sum += spacing) {
    cairo_move_to(cr, sum - top, top);
    cairo_line_to(cr, sum - bottom, bottom);
  }
  draw(cr, stroke);
  cairo_restore(cr);
}

void Pen::ring(Point centre, double radius, const Stroke& stroke) {
  cairo_new_path(sheet_->cr());
  cairo_arc(sheet_->cr(), centre.x_m, centre.y_m, radius, 0, kTurn);
  draw(sheet_->cr(), stroke);
}

void Pen::disc(Point centre, double radius, Tint tint) {
  cairo_new_path(sheet_->cr());
  cairo_arc(sheet_->cr(), centre.x_m, centre.y_m, radius, 0, kTurn);
  ink(sheet_->cr(), tint);
  cairo_fill(sheet_->cr());
}

void Pen::text(const std::string& words, Point at, const Lettering& lettering) {
  cairo_t* const cr = sheet_->cr();
  font(cr, lettering);
  const double width = extents_of(cr, words).x_advance;
  const double squeeze = std::min(1.0, lettering.room / std::max(width, 1.0));
  cairo_save(cr);
  cairo_translate(cr, at.x_m - lettering.align * width * squeeze, at.y_m);
  cairo_scale(cr, squeeze, squeeze);
  cairo_move_to(cr, 0, 0);
  cairo_show_text(cr, words.c_str());
  cairo_restore(cr);
}

void Pen::centred_text(const std::string& words, Point at, const Lettering& lettering) {
  cairo_t* const cr = sheet_->cr();
  font(cr, lettering);
  const cairo_text_extents_t extents = extents_of(cr, words);
  cairo_move_to(cr, at.x_m - extents.width / 2 - extents.x_bearing, at.y_m - extents.height / 2 - extents.y_bearing);
  cairo_show_text(cr, words.c_str());
}

void Pen::image(Sprite& sprite, Point lower_left, double px_per_pixel, bool smooth) {
  // cairo 1.16 loses the memory of a source that is set after a failure.
  if (!ok()) {
    return;
  }
  const Surface surface(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(sprite.pixels.data()),
                                                            CAIRO_FORMAT_ARGB32, sprite.width, sprite.height,
                                                            4 * sprite.width));
  cairo_t* const cr = sheet_->cr();
  cairo_save(cr);
  cairo_translate(cr, lower_left.x_m, lower_left.y_m - sprite.height * px_per_pixel);
  cairo_scale(cr, px_per_pixel, px_per_pixel);
  cairo_set_source_surface(cr, surface.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cr), smooth ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  cairo_pattern_set_extend(cairo_get_source(cr), CAIRO_EXTEND_PAD);
  cairo_paint(cr);
  cairo_restore(cr);
}

Result<std::string> Pen::png() const {
  std::string png;
  cairo_status_t status = cairo_status(sheet_->cr());
  if (status == CAIRO_STATUS_SUCCESS) {
    status = cairo_surface_write_to_png_stream(sheet_->surface.get(), &append, &png);
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    return Error{std::string("the picture cannot be drawn: ") + cairo_status_to_string(status)};
  }
  return png;
}

}  // namespace ivo::firmware
