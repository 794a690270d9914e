#include "firmware/files/picture_layout.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "firmware/files/number_text.hpp"

namespace ivo::firmware {
namespace {

constexpr double kLongSide = 1600.0;
constexpr double kLeft = 66.0;  // room for the numbers along the left edge
constexpr double kRight = 40.0;
constexpr double kTop = 118.0;    // title and figures
constexpr double kBottom = 60.0;  // numbers along the bottom edge
constexpr double kPanel = 350.0;  // legend on the right
constexpr double kGap = 44.0;
constexpr double kLeastWidth = 900.0;
constexpr Tint kInk = {0.30, 0.30, 0.32};

std::string kind_of(const PicturedAgent& agent) {
  return agent.name + (agent.kind == AgentKind::kRobot ? " (robot)" : " (person)");
}

LegendBlock who(const SearchPicture& picture) {
  LegendBlock block{"Who searches", {}, 1, {}};
  for (std::size_t i = 0; i < picture.agents.size(); ++i) {
    block.rows.push_back({Symbol::kAgent, agent_tint(picture.agents, i), kind_of(picture.agents[i])});
  }
  return block;
}

LegendBlock what(const SearchPicture& picture, double scale_m) {
  const auto any = [&](auto has) { return std::any_of(picture.agents.begin(), picture.agents.end(), has); };
  LegendBlock block{"Lines and marks", {}, 1, {}};
  if (any([](const PicturedAgent& a) { return !a.plan.empty(); })) {
    block.rows.push_back({Symbol::kPlan, kInk, "plan"});
  }
  if (any([](const PicturedAgent& a) { return !a.track.empty(); })) {
    block.rows.push_back({Symbol::kTrack, kInk, "way gone, drawn beside it"});
  }
  if (const std::vector<std::size_t> left = standing_at_the_end(picture); !left.empty()) {
    const bool one = left.size() == 1;
    block.rows.push_back({Symbol::kEnd, one ? agent_tint(picture.agents, left[0]) : kInk,
                          one ? picture.agents[left[0]].name + " at the end" : "at the end"});
  }
  if (any([](const PicturedAgent& a) { return !a.preferred.empty(); })) {
    block.rows.push_back({Symbol::kPreferred, kInk, "preferred area"});
  }
  if (any([](const PicturedAgent& a) { return !a.restricted.empty(); })) {
    block.rows.push_back({Symbol::kRestricted, kInk, "restricted area"});
  }
  if (picture.object) {
    block.rows.push_back({Symbol::kObject, kInk, "object"});
  }
  if (picture.find) {
    block.rows.push_back({Symbol::kSight, agent_tint(picture.agents, picture.find->agent),
                          "found by " + picture.agents[picture.find->agent].name + ", sight " +
                              shortest(picture.find->sight_radius_m) + " m"});
  }
  block.rows.push_back({Symbol::kScale, kInk, shortest(scale_m) + " m"});
  return block;
}

LegendBlock likely(const SearchPicture& picture) {
  LegendBlock block{"Where it probably is", {}, 1, {}};
  const double density = full_heat_density(picture.mass, picture.cell_m);
  if (picture.alike) {
    block.rows.push_back({Symbol::kWords, kInk, "everywhere alike"});
  } else if (density > 0) {
    char text[48];
    std::snprintf(text, sizeof text, "\u2265 %.2g %% a square metre", 100 * density);
    block.rows.push_back({Symbol::kHeat, kInk, text});
    block.rows.push_back({Symbol::kWords, kInk, ""});  // the bar's numbers stand there
  }
  if (std::find(picture.out_of_sight.begin(), picture.out_of_sight.end(), true) != picture.out_of_sight.end()) {
    block.rows.push_back({Symbol::kUnseen, kInk, "out of sight"});
  }
  return block;
}

LegendBlock ground(const SearchPicture& picture) {
  std::array<bool, kClasses> present{};
  for (const SemanticClass c : picture.map->pixels) {
    present[static_cast<std::size_t>(c)] = true;
  }
  LegendBlock block{"Map", {}, 2, {}};
  const std::array<Tint, kClasses> palette = calm_palette();
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (present[i]) {
      block.rows.push_back({Symbol::kClass, palette[i], std::string(name_of(static_cast<SemanticClass>(i)))});
    }
  }
  return block;
}

double height_of(const LegendBlock& block) {
  const double lines = std::ceil(static_cast<double>(block.rows.size()) / block.columns);
  return PictureLayout::kHeadingHeight + lines * PictureLayout::kRowHeight;
}

std::vector<LegendBlock> legend_of(const SearchPicture& picture, double scale_m) {
  std::vector<LegendBlock> blocks = {who(picture), what(picture, scale_m), likely(picture), ground(picture)};
  blocks.erase(std::remove_if(blocks.begin(), blocks.end(), [](const LegendBlock& b) { return b.rows.empty(); }),
               blocks.end());
  return blocks;
}

}  // namespace

PictureLayout lay_out(const SearchPicture& picture) {
  const double width_m = picture.map->width_px * picture.map->resolution_m;
  const double height_m = picture.map->height_px * picture.map->resolution_m;
  const bool beside = height_m > 0.87 * width_m;

  PictureLayout layout;
  layout.legend = legend_of(picture, layout.scale_m);
  double tallest = 0.0;
  for (const LegendBlock& block : layout.legend) {
    tallest = std::max(tallest, height_of(block));
  }
  const double around_x = kLeft + kRight + (beside ? kGap + kPanel : 0.0);
  const double around_y = kTop + kBottom + (beside ? 0.0 : tallest + kRight);
  layout.px_per_m = std::min((kLongSide - around_x) / width_m, (kLongSide - around_y) / height_m);
  layout.map = {kLeft, kTop, width_m * layout.px_per_m, height_m * layout.px_per_m};
  const double width = std::max(layout.map.width + around_x, kLeastWidth);
  double height = layout.map.height + around_y;
  layout.title = {kLeft, 34.0, width - kLeft - kRight, kTop - 46.0};
  // The scale bar fits in the legend's symbols at twice their width.
  layout.scale_m = round_length(2 * PictureLayout::kSymbolWidth / layout.px_per_m);
  layout.grid_m = round_length(170.0 / layout.px_per_m);
  layout.legend = legend_of(picture, layout.scale_m);

  if (beside) {
    const double x = layout.map.x + layout.map.width + kGap;
    double y = kTop - 6.0;
    for (LegendBlock& block : layout.legend) {
      block.box = {x, y, kPanel, height_of(block)};
      y += block.box.height + 22.0;
    }
    height = std::max(height, y + kRight);
  } else {
    const double each = (width - kLeft - kRight) / static_cast<double>(layout.legend.size());
    for (std::size_t i = 0; i < layout.legend.size(); ++i) {
      layout.legend[i].box = {kLeft + each * static_cast<double>(i), kTop + layout.map.height + kBottom, each - 20.0,
                              height_of(layout.legend[i])};
    }
  }
  layout.width_px = static_cast<int>(std::ceil(width));
  layout.height_px = static_cast<int>(std::ceil(height));
  return layout;
}

}  // namespace ivo::firmware
