// Where everything of a picture goes, in pixels from the top left, and what its legend says.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/files/picture.hpp"
#include "firmware/files/picture_style.hpp"

namespace ivo::firmware {

struct Box {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
};

enum class Symbol : std::uint8_t {
  kAgent,
  kPlan,
  kTrack,
  kEnd,
  kPreferred,
  kRestricted,
  kObject,
  kSight,
  kClass,
  kHeat,
  kUnseen,
  kScale,
  kWords
};

struct LegendRow {
  Symbol symbol;
  Tint tint;
  std::string text;
};

struct LegendBlock {
  std::string heading;
  std::vector<LegendRow> rows;
  int columns = 1;
  Box box;
};

struct PictureLayout {
  static constexpr double kRowHeight = 31.0;
  static constexpr double kHeadingHeight = 40.0;
  static constexpr double kSymbolWidth = 62.0;

  int width_px = 0;
  int height_px = 0;
  Box title;
  Box map;
  double px_per_m = 1.0;
  double scale_m = 1.0;  ///< length of the scale bar
  double grid_m = 1.0;   ///< between the numbers along the map's edges
  std::vector<LegendBlock> legend;
};

/// Legend on the right of tall and square maps, below wide ones; nothing overlaps.
[[nodiscard]] PictureLayout lay_out(const SearchPicture& picture);

}  // namespace ivo::firmware
