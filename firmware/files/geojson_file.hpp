// Areas as GeoJSON (RFC 7946) for other tools, but in metres of the map's frame, as the file says itself: RFC 7946
// knows degrees alone, and a garden of 20 m has none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.hpp"
#include "config/mission.hpp"

namespace ivo::firmware {

enum class DrawnPurpose : std::uint8_t {
  kPreferred,  ///< where the agent would rather search
  kNoGo,       ///< where the agent may not be
};

struct DrawnArea {
  DrawnPurpose purpose{};
  std::optional<std::string> agent;  ///< none: everybody, of kNoGo alone
  std::optional<int> slot;           ///< where it stands among the areas; none: the next free one
  Polygon polygon;
  friend bool operator==(const DrawnArea&, const DrawnArea&) = default;
};

inline constexpr std::size_t kDrawnAreas = 32;

/// A FeatureCollection with the foreign members "frame": "map" and "unit": "metre", and an area a Feature: a Polygon of
/// one closed ring, properties "purpose" ("preferred" or "no_go"), "agent" (a name or null) and "slot". Read back it is
/// the same, to the last bit.
[[nodiscard]] std::string geojson_text(const std::vector<DrawnArea>& areas);

/// Refuses, by feature, what is no area of ours: another geometry, a ring that is not closed, a hole, fewer than 3 or
/// more than 64 corners, a border that crosses itself, corners that are not within 1e6 m, an agent that is not among
/// `agents`, a slot twice; and a file that says that it is not in metres of the map. `frame` and `unit` may be missing;
/// properties of others are passed over.
[[nodiscard]] Result<std::vector<DrawnArea>> parse_geojson(std::string_view text, const std::string& path,
                                                           const std::vector<std::string>& agents);

}  // namespace ivo::firmware
