// PNG images as colours. Grey ones as numbers: grey_image.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "config/semantic_class.hpp"

namespace ivo::firmware {

/// More pixels are refused before memory is taken.
inline constexpr std::int64_t kMostPixels = 64'000'000;

struct ColourImage {
  int width_px = 0;
  int height_px = 0;
  bool alpha = false;          ///< the file says how transparent pixels are; that was ignored
  std::vector<Colour> pixels;  ///< row by row, the bottom row first
};

/// Any PNG: colour, palette or grey, 1 to 16 bits, plain or interlaced. Values come as stored, without colour
/// management, because a class is an exact colour; 16 bits are scaled to 8, an alpha channel is ignored.
/// Refuses what is missing, no PNG, cut short or damaged, and more than kMostPixels, in one line that names the path.
[[nodiscard]] Result<ColourImage> read_colours(const std::string& path);

}  // namespace ivo::firmware
