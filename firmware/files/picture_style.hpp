// The look of a picture: colours, and the geometry of marks on lines. No drawing here.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/semantic_class.hpp"
#include "firmware/files/picture.hpp"

namespace ivo::firmware {

/// Each from 0 to 1.
struct Tint {
  double r = 0.0;
  double g = 0.0;
  double b = 0.0;
  double alpha = 1.0;
};

/// The same colour, less opaque.
[[nodiscard]] Tint faded(Tint tint, double alpha);

[[nodiscard]] Tint mixed(Tint a, Tint b, double share_of_b);

/// The robot red, the first person green, others in colours of their own.
[[nodiscard]] Tint agent_tint(std::span<const PicturedAgent> agents, std::size_t agent);

/// The built-in colours of the classes, lightened so that lines stand out on them; stairs in one that is not the
/// heat's.
[[nodiscard]] std::array<Tint, kClasses> calm_palette();

/// Lilac to deep violet, a hue that no class and no agent has, from clear to nearly opaque, for a level of 0 to 1.
[[nodiscard]] Tint heat(double level);

/// The density, mass a square metre, that heat(1) shows: below it lies 98 % of the mass, so that a single large cell
/// does not hide the rest; but at least thrice the mean, so that an even prior looks even and faint. 0 without mass.
/// Cost: sorts the cells.
[[nodiscard]] double full_heat_density(std::span<const double> mass, double cell_m);

/// 1, 2 or 5 times a power of ten, the largest not above `most`.
[[nodiscard]] double round_length(double most);

struct Mark {
  Point at;
  double heading_rad = 0.0;
};

/// Places along a line for arrows, about `spacing` apart, none within `clear` of a corner or of another's place.
/// Lengths in the line's own unit.
[[nodiscard]] std::vector<Mark> arrows_along(std::span<const Point> line, double spacing, double clear);

/// The agents other than the finder whose tracks end somewhere.
[[nodiscard]] std::vector<std::size_t> standing_at_the_end(const SearchPicture& picture);

/// The line moved to the right of its direction by `offset`, thinned to points at least `step` apart. Its segments keep
/// their directions; at a sharp turn it goes round the corner.
[[nodiscard]] std::vector<Point> beside_line(std::span<const Point> line, double offset, double step);

}  // namespace ivo::firmware
