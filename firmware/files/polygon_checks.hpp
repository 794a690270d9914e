// What a drawn area must be before anyone relies on it.
#pragma once

#include <optional>
#include <string>

#include "config/mission.hpp"

namespace ivo::firmware {

/// Why the polygon is not simple, in one line ("... ; expected ..."), or nothing. At least three vertices are given.
/// Cost: the square of the vertices.
[[nodiscard]] std::optional<std::string> fault_of(const Polygon& polygon);

}  // namespace ivo::firmware
