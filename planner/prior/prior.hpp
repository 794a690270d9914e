// Priors: where the object may be, before anybody looked. Each fills one mass a cell, 0 on obstacles, not normalised;
// the sum is made 1 over the observable cells once those are known (preferences.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "planner/world/cells.hpp"

namespace ivo::planner {

struct GaussianComponent {
  Point mean;
  double sigma_m = 1.0;  ///< the same in every direction
  double weight = 1.0;   ///< mass of the whole component, relative to the others
};

/// A grey image whose lower-left corner lies on the map's; a view, bottom row first.
struct GreyView {
  std::span<const std::uint16_t> values;
  int width_px = 0;
  int height_px = 0;
  double resolution_m = 0.0;
};

/// Mass a square metre of a component, times its weight, but for a factor that all have.
[[nodiscard]] double density(const GaussianComponent& component, Point p) noexcept;
/// The value of the pixel under `p`; 0 outside the image.
[[nodiscard]] double value_at(const GreyView& image, Point p) noexcept;

/// Cost of each: the cells (times the components).
void fill_uniform(const Cells& cells, std::span<double> mass) noexcept;
void fill_gaussian_mixture(const Cells& cells, std::span<const GaussianComponent> components,
                           std::span<double> mass) noexcept;
/// The value of the pixel under a cell's centre; 0 outside the image.
void fill_from_image(const Cells& cells, const GreyView& image, std::span<double> mass) noexcept;

}  // namespace ivo::planner
