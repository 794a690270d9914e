// The only file that includes cairo.
#include "firmware/files/picture.hpp"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>

#include "config/base/contract.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/picture_layout.hpp"
#include "firmware/files/picture_style.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr Tint kPaper = {1.0, 1.0, 1.0};
constexpr Tint kText = {0.16, 0.16, 0.18};
constexpr Tint kQuiet = {0.45, 0.45, 0.48};
constexpr Tint kGold = {1.00, 0.82, 0.10};
constexpr Tint kBlack = {0.10, 0.10, 0.12};

struct Destroy {
  void operator()(cairo_surface_t* surface) const noexcept { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const noexcept { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Context = std::unique_ptr<cairo_t, Destroy>;

std::uint32_t premultiplied(Tint t) {
  const auto level = [](double v) { return static_cast<std::uint32_t>(std::lround(255.0 * v)); };
  return level(t.alpha) << 24 | level(t.r * t.alpha) << 16 | level(t.g * t.alpha) << 8 | level(t.b * t.alpha);
}

/// A surface of one pixel a value, the top row first; `tint` is asked by column and row from the bottom.
template <class TintAt>
Surface painted(int width, int height, TintAt tint) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
    return surface;
  }
  unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int row = 0; row < height; ++row) {
    auto* const line = reinterpret_cast<std::uint32_t*>(bytes + std::ptrdiff_t{stride} * (height - 1 - row));
    for (int column = 0; column < width; ++column) {
      line[column] = premultiplied(tint(column, row));
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

/// Which may take several bytes of UTF-8.
std::string first_letter(const std::string& name) {
  std::size_t end = 1;
  while (end < name.size() && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) {
    ++end;
  }
  return name.substr(0, end);
}

class Painter {
 public:
  Painter(cairo_t* cr, const SearchPicture& picture, const PictureLayout& layout)
      : cr_(cr), picture_(picture), layout_(layout) {}

  void paint() {
    ink(kPaper);
    cairo_paint(cr_);
    title();
    cairo_save(cr_);
    cairo_rectangle(cr_, layout_.map.x, layout_.map.y, layout_.map.width, layout_.map.height);
    cairo_clip(cr_);
    map(false);
    probability();
    map(true);
    for (std::size_t i = 0; i < picture_.agents.size(); ++i) {
      preferred(i);
    }
    for (std::size_t i = 0; i < picture_.agents.size(); ++i) {
      plan(i);
    }
    for (std::size_t i = 0; i < picture_.agents.size(); ++i) {
      track(i);
    }
    find();
    for (std::size_t i = 0; i < picture_.agents.size(); ++i) {
      start_mark(on_picture(picture_.agents[i].start), i);
    }
    if (picture_.object) {
      star(on_picture(*picture_.object), 17.0);
    }
    cairo_restore(cr_);
    edges();
    for (const LegendBlock& block : layout_.legend) {
      legend(block);
    }
  }

 private:
  void ink(Tint t) { cairo_set_source_rgba(cr_, t.r, t.g, t.b, t.alpha); }
  void ink(Tint t, double alpha) { cairo_set_source_rgba(cr_, t.r, t.g, t.b, alpha); }

  [[nodiscard]] Point on_picture(Point p) const {
    return {layout_.map.x + p.x_m * layout_.px_per_m, layout_.map.y + layout_.map.height - p.y_m * layout_.px_per_m};
  }
  [[nodiscard]] std::vector<Point> on_picture(const std::vector<Point>& line) const {
    std::vector<Point> moved;
    for (const Point p : line) {
      moved.push_back(on_picture(p));
    }
    return moved;
  }

  void font(double size, bool bold = false) {
    cairo_select_font_face(cr_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr_, size);
  }
  double width_of(const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(cr_, text.c_str(), &extents);
    return extents.x_advance;
  }
  /// On a base line, made narrower where it would leave `room`. `align`: 0 starts at x, 0.5 is centred, 1 ends there.
  void text(const std::string& words, Point at, double align = 0.0, double room = 1e9) {
    const double width = width_of(words);
    const double squeeze = std::min(1.0, room / std::max(width, 1.0));
    cairo_save(cr_);
    cairo_translate(cr_, at.x_m - align * width * squeeze, at.y_m);
    cairo_scale(cr_, squeeze, squeeze);
    cairo_move_to(cr_, 0, 0);
    cairo_show_text(cr_, words.c_str());
    cairo_restore(cr_);
  }
  void follow(const std::vector<Point>& line) {
    cairo_new_path(cr_);
    for (const Point p : line) {
      cairo_line_to(cr_, p.x_m, p.y_m);
    }
  }
  void circle(Point c, double radius) {
    cairo_new_path(cr_);
    cairo_arc(cr_, c.x_m, c.y_m, radius, 0, kTurn);
  }
  void stroke(double width) {
    cairo_set_line_width(cr_, width);
    cairo_stroke(cr_);
  }
  void dashes(double on, double off) {
    const double pattern[] = {on, off};
    cairo_set_dash(cr_, pattern, 2, 0);
  }
  void solid() { cairo_set_dash(cr_, nullptr, 0, 0); }

  void title() {
    ink(kText);
    font(31, true);
    text(picture_.title, {layout_.title.x, layout_.title.y + 24}, 0.0, layout_.title.width);
    ink(kQuiet);
    font(19);
    text(picture_.figures, {layout_.title.x, layout_.title.y + 58}, 0.0, layout_.title.width);
  }

  void stretch(cairo_surface_t* surface, double px_per_pixel, cairo_filter_t filter) {
    cairo_save(cr_);
    const double height = cairo_image_surface_get_height(surface) * px_per_pixel;
    cairo_translate(cr_, layout_.map.x, layout_.map.y + layout_.map.height - height);
    cairo_scale(cr_, px_per_pixel, px_per_pixel);
    cairo_set_source_surface(cr_, surface, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cr_), filter);
    cairo_pattern_set_extend(cairo_get_source(cr_), CAIRO_EXTEND_PAD);
    cairo_paint(cr_);
    cairo_restore(cr_);
  }

  /// Obstacles once more above the probability: it is blurred over a cell and must not stain walls.
  void map(bool obstacles_only) {
    const MapFile& map = *picture_.map;
    const planner::SegmentedMap view = map.view();
    const std::array<Tint, kClasses> palette = calm_palette();
    const Surface surface = painted(map.width_px, map.height_px, [&](int column, int row) {
      Tint tint = palette[static_cast<std::size_t>(view.at(column, row))];
      tint.alpha = obstacles_only && !view.obstacle(column, row) ? 0.0 : 1.0;
      return tint;
    });
    const double px_per_pixel = map.resolution_m * layout_.px_per_m;
    stretch(surface.get(), px_per_pixel, px_per_pixel > 5 ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  }

  void probability() {
    const double full = full_heat_density(picture_.mass, picture_.cell_m) * picture_.cell_m * picture_.cell_m;
    if (full <= 0) {
      return;
    }
    const Surface surface = painted(picture_.columns, picture_.rows, [&](int column, int row) {
      return heat(picture_.mass[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture_.columns) +
                                static_cast<std::size_t>(column)] /
                  full);
    });
    stretch(surface.get(), picture_.cell_m * layout_.px_per_m, CAIRO_FILTER_BILINEAR);
  }

  void preferred(std::size_t agent) {
    const Tint tint = agent_tint(picture_.agents, agent);
    for (const Polygon& area : picture_.agents[agent].preferred) {
      follow(on_picture(area));
      cairo_close_path(cr_);
      ink(tint, 0.045);
      cairo_fill_preserve(cr_);
      ink(tint, 0.75);
      dashes(2, 6);
      cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
      stroke(2.6);
      solid();
    }
  }

  void arrow(Mark mark, double size) {
    cairo_save(cr_);
    cairo_translate(cr_, mark.at.x_m, mark.at.y_m);
    cairo_rotate(cr_, mark.heading_rad);
    cairo_new_path(cr_);
    cairo_move_to(cr_, size, 0);
    cairo_line_to(cr_, -0.7 * size, 0.72 * size);
    cairo_line_to(cr_, -0.35 * size, 0);
    cairo_line_to(cr_, -0.7 * size, -0.72 * size);
    cairo_close_path(cr_);
    cairo_restore(cr_);
  }

  void planned_line(const std::vector<Point>& line, Tint tint, double spacing) {
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
    follow(line);
    ink(kPaper, 0.75);
    cairo_set_line_width(cr_, 7.0);
    cairo_stroke_preserve(cr_);
    ink(tint);
    stroke(3.4);
    for (const Mark& mark : arrows_along(line, spacing, 12.0)) {
      arrow(mark, 10.5);
      ink(kPaper, 0.9);
      cairo_set_line_width(cr_, 2.4);
      cairo_stroke_preserve(cr_);
      ink(tint);
      cairo_fill(cr_);
    }
  }

  void gone_line(const std::vector<Point>& line, Tint tint) {
    follow(line);
    ink(mixed(tint, kBlack, 0.55));
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_BUTT);
    dashes(9, 5);
    stroke(2.0);
    solid();
  }

  void plan(std::size_t agent) {
    if (picture_.agents[agent].plan.size() > 1) {
      planned_line(on_picture(picture_.agents[agent].plan), agent_tint(picture_.agents, agent), 110.0);
    }
  }

  void track(std::size_t agent) {
    const std::vector<Point>& track = picture_.agents[agent].track;
    if (track.size() > 1) {
      gone_line(beside_line(on_picture(track), -6.0, 3.0), agent_tint(picture_.agents, agent));
    }
  }

  void find() {
    if (!picture_.find) {
      return;
    }
    const Tint tint = agent_tint(picture_.agents, picture_.find->agent);
    const Point from = on_picture(picture_.find->from);
    circle(from, picture_.find->sight_radius_m * layout_.px_per_m);
    ink(tint, 0.13);
    cairo_fill_preserve(cr_);
    ink(tint, 0.9);
    stroke(2.2);
    if (picture_.object) {
      const Point object = on_picture(*picture_.object);
      follow({from, object});
      ink(kBlack, 0.8);
      dashes(2, 4);
      stroke(1.6);
      solid();
    }
    circle(from, 6.0);
    ink(kPaper);
    cairo_fill_preserve(cr_);
    ink(tint);
    stroke(3.0);
  }

  void start_mark(Point at, std::size_t agent) {
    badge(at, agent_tint(picture_.agents, agent), first_letter(picture_.agents[agent].name));
  }

  void badge(Point at, Tint tint, const std::string& letter) {
    circle(at, 15.0);
    ink(tint);
    cairo_fill_preserve(cr_);
    ink(kPaper);
    stroke(2.6);
    font(17, true);
    cairo_text_extents_t extents;
    cairo_text_extents(cr_, letter.c_str(), &extents);
    ink(kPaper);
    text(letter, {at.x_m - extents.width / 2 - extents.x_bearing, at.y_m - extents.height / 2 - extents.y_bearing});
  }

  void star(Point at, double radius) {
    cairo_new_path(cr_);
    for (int i = 0; i < 10; ++i) {
      const double r = i % 2 == 0 ? radius : 0.45 * radius;
      const double angle = kTurn * (i / 10.0 - 0.25);
      cairo_line_to(cr_, at.x_m + r * std::cos(angle), at.y_m + r * std::sin(angle));
    }
    cairo_close_path(cr_);
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    ink(kPaper);
    cairo_set_line_width(cr_, 7.0);
    cairo_stroke_preserve(cr_);
    ink(kBlack);
    cairo_set_line_width(cr_, 3.4);
    cairo_stroke_preserve(cr_);
    ink(kGold);
    cairo_fill(cr_);
  }

  void edges() {
    const Box& m = layout_.map;
    cairo_new_path(cr_);
    cairo_rectangle(cr_, m.x - 0.5, m.y - 0.5, m.width + 1, m.height + 1);
    ink(kQuiet);
    stroke(1.0);
    font(15);
    for (int i = 0; i * layout_.grid_m * layout_.px_per_m <= m.width; ++i) {
      const double x = m.x + i * layout_.grid_m * layout_.px_per_m;
      follow({{x, m.y + m.height + 1}, {x, m.y + m.height + 7}});
      stroke(1.0);
      text(shortest(i * layout_.grid_m) + (i == 0 ? " m" : ""), {x, m.y + m.height + 24}, 0.5);
    }
    for (int i = 1; i * layout_.grid_m * layout_.px_per_m <= m.height; ++i) {
      const double y = m.y + m.height - i * layout_.grid_m * layout_.px_per_m;
      follow({{m.x - 7, y}, {m.x - 1, y}});
      stroke(1.0);
      text(shortest(i * layout_.grid_m), {m.x - 11, y + 5.5}, 1.0);
    }
  }

  void legend(const LegendBlock& block) {
    ink(kText);
    font(18, true);
    text(block.heading, {block.box.x, block.box.y + 20}, 0.0, block.box.width);
    const int lines = (static_cast<int>(block.rows.size()) + block.columns - 1) / block.columns;
    const double column_width = block.box.width / block.columns;
    for (std::size_t i = 0; i < block.rows.size(); ++i) {
      const int column = static_cast<int>(i) / lines;
      const int line = static_cast<int>(i) % lines;
      const double x = block.box.x + column * column_width;
      const double y = block.box.y + PictureLayout::kHeadingHeight + (line + 0.5) * PictureLayout::kRowHeight;
      legend_row(block.rows[i], {x, y}, column_width);
    }
  }

  void legend_row(const LegendRow& row, Point at, double width) {
    const double symbol = row.symbol == Symbol::kClass ? 26.0
                          : row.symbol == Symbol::kScale ? layout_.scale_m * layout_.px_per_m
                                                         : PictureLayout::kSymbolWidth;
    if (row.symbol == Symbol::kHeat) {
      heat_bar(at, std::min(width - 10.0, 260.0), row.text);
      return;
    }
    legend_symbol(row, at, symbol);
    ink(kText);
    font(17);
    text(row.text, {at.x_m + symbol + 12, at.y_m + 6}, 0.0, width - symbol - 18);
  }

  void legend_symbol(const LegendRow& row, Point at, double width) {
    const Point middle = {at.x_m + width / 2, at.y_m};
    const std::vector<Point> line = {{at.x_m + 3, at.y_m}, {at.x_m + width - 3, at.y_m}};
    switch (row.symbol) {
      case Symbol::kAgent:
        planned_line(line, row.tint, 1e9);
        badge(middle, row.tint, first_letter(row.text));
        break;
      case Symbol::kPlan:
        planned_line(line, row.tint, width - 6);
        break;
      case Symbol::kTrack:
        gone_line(line, row.tint);
        break;
      case Symbol::kPreferred:
        cairo_new_path(cr_);
        cairo_rectangle(cr_, at.x_m + 4, at.y_m - 9, width - 8, 18);
        ink(row.tint, 0.75);
        cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
        dashes(2, 6);
        stroke(2.6);
        solid();
        break;
      case Symbol::kObject:
        star(middle, 12.0);
        break;
      case Symbol::kSight:
        circle(middle, 12.0);
        ink(row.tint, 0.13);
        cairo_fill_preserve(cr_);
        ink(row.tint, 0.9);
        stroke(2.2);
        break;
      case Symbol::kClass:
        cairo_new_path(cr_);
        cairo_rectangle(cr_, at.x_m + 0.5, at.y_m - 9.5, width, 19);
        ink(row.tint);
        cairo_fill_preserve(cr_);
        ink(kQuiet, 0.6);
        stroke(1.0);
        break;
      case Symbol::kScale:
        follow({{at.x_m + 1, at.y_m - 6}, {at.x_m + 1, at.y_m + 4}, {at.x_m + width, at.y_m + 4}, {at.x_m + width, at.y_m - 6}});
        ink(row.tint);
        cairo_set_line_cap(cr_, CAIRO_LINE_CAP_BUTT);
        stroke(2.0);
        break;
      case Symbol::kHeat:
        break;
    }
  }

  void heat_bar(Point at, double width, const std::string& most) {
    constexpr int kSteps = 130;
    const std::array<Tint, kClasses> palette = calm_palette();
    for (int i = 0; i < kSteps; ++i) {
      cairo_rectangle(cr_, at.x_m + width * i / kSteps, at.y_m - 10, width / kSteps + 0.5, 20);
      ink(palette[0]);
      cairo_fill_preserve(cr_);
      ink(heat((i + 0.5) / kSteps));
      cairo_fill(cr_);
    }
    font(15);
    ink(kText);
    text("0", {at.x_m, at.y_m + 30});
    text(most, {at.x_m + width, at.y_m + 30}, 1.0, width - 24);
  }

  cairo_t* cr_;
  const SearchPicture& picture_;
  const PictureLayout& layout_;
};

cairo_status_t append(void* out, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Result<std::string> picture_png(const SearchPicture& picture) {
  IVO_CONTRACT(picture.map != nullptr);
  IVO_CONTRACT(picture.mass.empty() ||
               picture.mass.size() == static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows));
  IVO_CONTRACT(!picture.find || picture.find->agent < picture.agents.size());
  const PictureLayout layout = lay_out(picture);
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, layout.width_px, layout.height_px));
  const Context context(cairo_create(surface.get()));
  Painter(context.get(), picture, layout).paint();
  std::string png;
  cairo_status_t status = cairo_status(context.get());
  if (status == CAIRO_STATUS_SUCCESS) {
    status = cairo_surface_write_to_png_stream(surface.get(), &append, &png);
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    return Error{std::string("the picture cannot be drawn: ") + cairo_status_to_string(status)};
  }
  return png;
}

Result<void> write_picture(const std::string& path, const SearchPicture& picture) {
  const Result<std::string> png = picture_png(picture);
  if (!png) {
    return Error{path + ": " + png.error().message};
  }
  return write_file(path, png.value());
}

}  // namespace ivo::firmware
