#include "firmware/files/picture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "config/base/contract.hpp"
#include "firmware/files/number_text.hpp"
#include "firmware/files/picture_layout.hpp"
#include "firmware/files/picture_marks.hpp"
#include "firmware/files/picture_pen.hpp"
#include "firmware/files/picture_style.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {
namespace {

constexpr Tint kText = {0.16, 0.16, 0.18};
constexpr Tint kQuiet = {0.45, 0.45, 0.48};

/// `tint` is asked by column and row, the bottom row first.
template <class TintAt>
Sprite painted(int width, int height, TintAt tint) {
  Sprite sprite{width, height, {}};
  sprite.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = height - 1; row >= 0; --row) {
    for (int column = 0; column < width; ++column) {
      sprite.pixels.push_back(premultiplied(tint(column, row)));
    }
  }
  return sprite;
}

/// What lies within the map's frame.
class Scene {
 public:
  Scene(Pen& pen, const SearchPicture& picture, const PictureLayout& layout)
      : pen_(pen), picture_(picture), layout_(layout) {}

  void draw() {
    pen_.clip(layout_.map);
    map(false);
    probability();
    out_of_sight();
    // Obstacles once more: the probability is blurred over a cell and must not stain walls.
    map(true);
    for_each_agent(&Scene::preferred);
    for_each_agent(&Scene::restricted);
    plans();
    tracks();
    find();
    for (const std::size_t i : standing_at_the_end(picture_)) {
      draw_stand(pen_, on_sheet(picture_.agents[i].track.back()), agent_tint(picture_.agents, i));
    }
    for_each_agent(&Scene::start);
    if (picture_.object) {
      draw_star(pen_, on_sheet(*picture_.object), 17.0);
    }
    pen_.unclip();
  }

 private:
  void for_each_agent(void (Scene::*step)(const PicturedAgent&, Tint)) {
    for (std::size_t i = 0; i < picture_.agents.size(); ++i) {
      (this->*step)(picture_.agents[i], agent_tint(picture_.agents, i));
    }
  }

  [[nodiscard]] Point on_sheet(Point p) const {
    return {layout_.map.x + p.x_m * layout_.px_per_m, layout_.map.y + layout_.map.height - p.y_m * layout_.px_per_m};
  }
  [[nodiscard]] std::vector<Point> on_sheet(const std::vector<Point>& line) const {
    std::vector<Point> moved;
    moved.reserve(line.size());
    for (const Point p : line) {
      moved.push_back(on_sheet(p));
    }
    return moved;
  }

  void map(bool obstacles_only) {
    const MapFile& map = *picture_.map;
    const planner::SegmentedMap view = map.view();
    const std::array<Tint, kClasses> palette = calm_palette();
    Sprite sprite = painted(map.width_px, map.height_px, [&](int column, int row) {
      Tint tint = palette[static_cast<std::size_t>(view.at(column, row))];
      tint.alpha = obstacles_only && !view.obstacle(column, row) ? 0.0 : 1.0;
      return tint;
    });
    const double px_per_pixel = map.resolution_m * layout_.px_per_m;
    pen_.image(sprite, on_sheet({0, 0}), px_per_pixel, px_per_pixel < 5);
  }

  void probability() {
    const double full = full_heat_density(picture_.mass, picture_.cell_m) * picture_.cell_m * picture_.cell_m;
    if (full <= 0 || picture_.alike) {
      return;
    }
    const auto columns = static_cast<std::size_t>(picture_.columns);
    Sprite sprite = painted(picture_.columns, picture_.rows, [&](int column, int row) {
      return heat(picture_.mass[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] / full);
    });
    pen_.image(sprite, on_sheet({0, 0}), picture_.cell_m * layout_.px_per_m, true);
  }

  void out_of_sight() {
    std::vector<std::vector<Point>> stretches;
    const auto at = [&](int column, int row) {
      return picture_.out_of_sight[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture_.columns) +
                                   static_cast<std::size_t>(column)];
    };
    for (int row = 0; row < picture_.rows && !picture_.out_of_sight.empty(); ++row) {
      for (int column = 0; column < picture_.columns; ++column) {
        const int first = column;
        while (column < picture_.columns && at(column, row)) {
          ++column;
        }
        if (column > first) {
          const double low = row * picture_.cell_m;
          const double high = low + picture_.cell_m;
          stretches.push_back(on_sheet(Polygon{{first * picture_.cell_m, low},
                                               {column * picture_.cell_m, low},
                                               {column * picture_.cell_m, high},
                                               {first * picture_.cell_m, high}}));
        }
      }
    }
    if (!stretches.empty()) {
      draw_out_of_sight(pen_, stretches);
    }
  }

  void preferred(const PicturedAgent& agent, Tint tint) {
    for (const Polygon& area : agent.preferred) {
      draw_area_outline(pen_, on_sheet(area), tint);
    }
  }

  void restricted(const PicturedAgent& agent, Tint tint) {
    for (const Polygon& area : agent.restricted) {
      draw_restricted(pen_, on_sheet(area), tint);
    }
  }

  [[nodiscard]] static double aside_px(std::size_t agent) { return 3.5 * static_cast<double>(agent); }

  /// Side by side where agents share a way.
  void plans() {
    std::vector<std::vector<Point>> lines;
    for (std::size_t i = 0; i < picture_.agents.size(); ++i) {
      const std::vector<Point> line = on_sheet(picture_.agents[i].plan);
      lines.push_back(beside_line(line, aside_px(i), 0.0));
      draw_plan_ground(pen_, lines.back());
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      draw_plan(pen_, lines[i], agent_tint(picture_.agents, i), 110.0);
    }
  }

  /// Each to the left of its plan.
  void tracks() {
    for (std::size_t i = 0; i < picture_.agents.size(); ++i) {
      const std::vector<Point> line = on_sheet(picture_.agents[i].track);
      draw_track(pen_, beside_line(line, aside_px(i) - 6.0, 3.0), agent_tint(picture_.agents, i));
    }
  }

  void start(const PicturedAgent& agent, Tint tint) { draw_badge(pen_, on_sheet(agent.start), tint, agent.name); }

  void find() {
    if (!picture_.find) {
      return;
    }
    const Tint tint = agent_tint(picture_.agents, picture_.find->agent);
    const Point from = on_sheet(picture_.find->from);
    draw_sight(pen_, from, picture_.find->sight_radius_m * layout_.px_per_m, tint);
    if (picture_.object) {
      pen_.line(std::array{from, on_sheet(*picture_.object)}, {faded(kText, 0.8), 1.6, 2, 4});
    }
    draw_stand(pen_, from, tint);
  }

  Pen& pen_;
  const SearchPicture& picture_;
  const PictureLayout& layout_;
};

void draw_frame(Pen& pen, const PictureLayout& layout) {
  const Box& m = layout.map;
  const double bottom = m.y + m.height;
  const Stroke thin = {kQuiet, 1.0, 0, 0, false};
  pen.outline(rectangle({m.x - 0.5, m.y - 0.5, m.width + 1, m.height + 1}), thin);
  const double step = layout.grid_m * layout.px_per_m;
  for (int i = 0; i * step <= m.width; ++i) {
    const double x = m.x + i * step;
    pen.line(std::array{Point{x, bottom + 1}, Point{x, bottom + 7}}, thin);
    pen.text(shortest(i * layout.grid_m) + (i == 0 ? " m" : ""), {x, bottom + 24}, {kQuiet, 15, false, 0.5});
  }
  for (int i = 1; i * step <= m.height; ++i) {
    const double y = bottom - i * step;
    pen.line(std::array{Point{m.x - 7, y}, Point{m.x - 1, y}}, thin);
    pen.text(shortest(i * layout.grid_m), {m.x - 11, y + 5.5}, {kQuiet, 15, false, 1.0});
  }
}

void draw_symbol(Pen& pen, const LegendRow& row, Point at, double width) {
  const Point middle = {at.x_m + width / 2, at.y_m};
  const std::vector<Point> line = {{at.x_m + 3, at.y_m}, {at.x_m + width - 3, at.y_m}};
  switch (row.symbol) {
    case Symbol::kAgent:
      draw_plan(pen, line, row.tint, 1e9);
      draw_badge(pen, middle, row.tint, row.text);
      break;
    case Symbol::kPlan:
      draw_plan(pen, line, row.tint, width - 6);
      break;
    case Symbol::kTrack:
      draw_track(pen, line, row.tint);
      break;
    case Symbol::kPreferred:
      draw_area_outline(pen, rectangle({at.x_m + 4, at.y_m - 9, width - 8, 18}), row.tint);
      break;
    case Symbol::kRestricted:
      draw_restricted(pen, rectangle({at.x_m + 4, at.y_m - 9, width - 8, 18}), row.tint);
      break;
    case Symbol::kEnd:
      draw_stand(pen, middle, row.tint);
      break;
    case Symbol::kObject:
      draw_star(pen, middle, 12.0);
      break;
    case Symbol::kSight:
      draw_sight(pen, middle, 12.0, row.tint);
      break;
    case Symbol::kClass: {
      const std::vector<Point> swatch = rectangle({at.x_m + 0.5, at.y_m - 9.5, width, 19});
      pen.area(swatch, row.tint);
      pen.outline(swatch, {faded(kQuiet, 0.6), 1.0});
      break;
    }
    case Symbol::kScale:
      pen.line(std::array{Point{at.x_m + 1, at.y_m - 6}, Point{at.x_m + 1, at.y_m + 4},
                          Point{at.x_m + width, at.y_m + 4}, Point{at.x_m + width, at.y_m - 6}},
               {row.tint, 2.0, 0, 0, false});
      break;
    case Symbol::kUnseen: {
      const std::vector<Point> swatch = rectangle({at.x_m + 0.5, at.y_m - 9.5, width, 19});
      draw_out_of_sight(pen, std::array{swatch});
      pen.outline(swatch, {faded(kQuiet, 0.6), 1.0});
      break;
    }
    case Symbol::kHeat:
    case Symbol::kWords:
      break;
  }
}

void draw_heat_bar(Pen& pen, Point at, double width, const std::string& most) {
  constexpr int kSteps = 130;
  const Tint ground = calm_palette()[static_cast<std::size_t>(SemanticClass::kPavement)];
  for (int i = 0; i < kSteps; ++i) {
    const Tint over = heat((i + 0.5) / kSteps);
    const Tint seen = mixed(ground, faded(over, 1.0), over.alpha);
    pen.area(rectangle({at.x_m + width * i / kSteps, at.y_m - 10, width / kSteps + 0.5, 20}), seen);
  }
  pen.text("0", {at.x_m, at.y_m + 30}, {kText, 15});
  pen.text(most, {at.x_m + width, at.y_m + 30}, {kText, 15, false, 1.0, width - 24});
}

void draw_legend(Pen& pen, const LegendBlock& block, double scale_px) {
  pen.text(block.heading, {block.box.x, block.box.y + 20}, {kText, 18, true, 0.0, block.box.width});
  const std::size_t columns = static_cast<std::size_t>(block.columns);
  const std::size_t lines = (block.rows.size() + columns - 1) / columns;
  const double width = block.box.width / block.columns;
  for (std::size_t i = 0; i < block.rows.size(); ++i) {
    const LegendRow& row = block.rows[i];
    const std::size_t column = i / lines;
    const Point at = {block.box.x + static_cast<double>(column) * width,
                      block.box.y + PictureLayout::kHeadingHeight +
                          (static_cast<double>(i % lines) + 0.5) * PictureLayout::kRowHeight};
    if (row.symbol == Symbol::kHeat) {
      draw_heat_bar(pen, at, std::min(width - 10.0, 260.0), row.text);
      continue;
    }
    if (row.symbol == Symbol::kWords) {
      pen.text(row.text, {at.x_m, at.y_m + 6}, {kText, 17, false, 0.0, width});
      continue;
    }
    const bool swatch = row.symbol == Symbol::kClass || row.symbol == Symbol::kUnseen;
    const double symbol = swatch ? 26.0 : row.symbol == Symbol::kScale ? scale_px : PictureLayout::kSymbolWidth;
    draw_symbol(pen, row, at, symbol);
    pen.text(row.text, {at.x_m + symbol + 12, at.y_m + 6}, {kText, 17, false, 0.0, width - symbol - 18});
  }
}

}  // namespace

Result<std::string> picture_png(const SearchPicture& picture) {
  IVO_CONTRACT(picture.map != nullptr);
  IVO_CONTRACT(picture.mass.empty() || picture.mass.size() == static_cast<std::size_t>(picture.columns) *
                                                                  static_cast<std::size_t>(picture.rows));
  IVO_CONTRACT(picture.out_of_sight.empty() || picture.out_of_sight.size() == picture.mass.size());
  IVO_CONTRACT(!picture.find || picture.find->agent < picture.agents.size());
  const PictureLayout layout = lay_out(picture);
  Pen pen(layout.width_px, layout.height_px, kWhite);
  pen.text(picture.title, {layout.title.x, layout.title.y + 24}, {kText, 31, true, 0.0, layout.title.width});
  pen.text(picture.figures, {layout.title.x, layout.title.y + 58}, {kQuiet, 19, false, 0.0, layout.title.width});
  Scene(pen, picture, layout).draw();
  draw_frame(pen, layout);
  for (const LegendBlock& block : layout.legend) {
    draw_legend(pen, block, layout.scale_m * layout.px_per_m);
  }
  return pen.png();
}

Result<void> write_picture(const std::string& path, const SearchPicture& picture) {
  const Result<std::string> png = picture_png(picture);
  if (!png) {
    return Error{path + ": " + png.error().message};
  }
  return write_file(path, png.value());
}

}  // namespace ivo::firmware
