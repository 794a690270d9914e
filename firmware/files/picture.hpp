// A search as a picture: the map in calm colours, where the object probably is, who goes where, what was found.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "config/mission.hpp"
#include "config/semantic_class.hpp"
#include "firmware/files/map_file.hpp"

namespace ivo::firmware {

struct PicturedAgent {
  std::string name;
  AgentKind kind = AgentKind::kRobot;
  Point start;
  std::vector<Point> plan;   ///< waypoints, from the start; empty: none
  std::vector<Point> track;  ///< driven or walked, as often sampled as one likes; empty: none
  std::vector<Polygon> preferred;
  std::vector<Polygon> restricted;
};

struct PicturedFind {
  std::size_t agent = 0;  ///< the finder, in agents
  Point from;             ///< where it stood
  double sight_radius_m = 0.0;
};

struct SearchPicture {
  const MapFile* map = nullptr;  ///< must be given
  std::span<const double>
      mass;  ///< by cell, the bottom row first; empty: none. Else columns x rows, finite, not negative
  int columns = 0;
  int rows = 0;
  double cell_m = 0.0;
  bool alike = false;              ///< the prior is uniform: said in words, not shown as heat
  std::vector<bool> out_of_sight;  ///< by cell, as mass: it may be there and nobody can look; empty: none
  std::vector<PicturedAgent> agents;
  std::optional<Point> object;
  std::optional<PicturedFind> find;
  std::string title;
  std::string figures;  ///< one line below the title; may be empty
};

/// The picture as a PNG, 1600 pixels on its long side, legend beside the map or below it. Map classes are shown in the
/// product's own colours, whatever the image's were. Same picture and same fonts, same bytes. Text is UTF-8, set in
/// DejaVu Sans. Cost: some hundred milliseconds, memory for the map's pixels and the picture's. Fails when cairo does.
[[nodiscard]] Result<std::string> picture_png(const SearchPicture& picture);

/// The same into a file, at once (text_file.hpp).
[[nodiscard]] Result<void> write_picture(const std::string& path, const SearchPicture& picture);

}  // namespace ivo::firmware
