// Areas for other programs, and from them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/base/result.hpp"
#include "firmware/files/keepout_mask.hpp"
#include "firmware/web/request.hpp"
#include "firmware/web/view.hpp"

namespace ivo::firmware::web {

/// As GeoJSON; none as long as the controller has said no areas.
[[nodiscard]] std::optional<std::string> areas_geojson(const View& view);

/// What makes the areas those of `text`, GeoJSON: areas that are not in it are removed, one without a slot gets a free
/// one. Refuses what geojson_file.hpp refuses.
[[nodiscard]] Result<std::vector<Request>> requests_of_geojson(const std::string& text, const View& view);

/// No-go areas and obstacles; none as long as mission and map are not known.
[[nodiscard]] std::optional<KeepoutMask> keepout_of(const View& view);

}  // namespace ivo::firmware::web
