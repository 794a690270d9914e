// Grey images as PGM, binary (P5) or as text (P2): what maps of ROS are kept in.
#pragma once

#include <string>
#include <string_view>

#include "config/base/result.hpp"
#include "firmware/files/grey_image.hpp"

namespace ivo::firmware {

struct PgmImage {
  GreyImage grey;
  int white = 255;  ///< the value of white, 1 to 65535
};

/// One image, comments in its header passed over. Refuses what is no PGM, cut short, has values above its own white,
/// bytes behind a binary image, and more than kMostPixels, in one line that names the path.
[[nodiscard]] Result<PgmImage> parse_pgm(std::string_view bytes, const std::string& path);

}  // namespace ivo::firmware
