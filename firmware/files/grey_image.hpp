// A grey image as numbers: a prior as an image.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/base/result.hpp"

namespace ivo::firmware {

struct GreyImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> values;  ///< row by row, the bottom row first; 0 to 255 or 0 to 65535 as the file has them
};

/// A grey PNG of up to 8 or of 16 bits; fewer than 8 are widened to 0 to 255, an alpha channel is ignored.
/// Refuses colour, what is no whole PNG, and more than kMostPixels.
[[nodiscard]] Result<GreyImage> read_grey(const std::string& path);

}  // namespace ivo::firmware
