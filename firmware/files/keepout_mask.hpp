// No-go areas as a costmap filter mask of Nav2: what its map server loads for a keep-out filter.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "config/base/geometry.hpp"
#include "config/mission.hpp"

namespace ivo::firmware {

/// The pixels of a mask. Views.
struct MaskedMap {
  int width_px = 0;
  int height_px = 0;
  double resolution_m = 0.0;
  Point origin_m;                           ///< of the lower-left corner in the frame of who reads the mask
  std::span<const std::uint8_t> obstacles;  ///< a byte a pixel, the bottom row first, 0: free; empty: no obstacles
  std::span<const Polygon> no_go;           ///< in the map's own frame
};

struct KeepoutMask {
  std::string pgm;   ///< binary (P5): 0 is kept out, 254 is free, as map_saver writes them
  std::string yaml;  ///< names the image; mode trinary
};

/// A pixel is kept out when its centre lies in a no-go area or when it is an obstacle. `image` is the name by which the
/// PGM will lie beside the yaml. Areas of fewer than three corners or more than limits::kPolygonVertices have no
/// pixels.
[[nodiscard]] KeepoutMask keepout_mask(const MaskedMap& map, const std::string& image);

/// A byte a pixel, the bottom row first: 1 where its centre lies in one of the areas.
[[nodiscard]] std::string pixels_within(int width_px, int height_px, double resolution_m,
                                        std::span<const Polygon> areas);

}  // namespace ivo::firmware
