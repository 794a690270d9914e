#include "planner/prior/prior.hpp"

#include "planner/numeric/exponential.hpp"

namespace ivo::planner {
namespace {

template <class MassAt>
void fill_free_cells(const Cells& cells, std::span<double> mass, MassAt&& mass_at) noexcept {
  for (Cell c = 0; c < cells.count(); ++c) {
    mass[static_cast<std::size_t>(c)] = cells.obstacle(c) ? 0.0 : mass_at(cells.centre(c));
  }
}

}  // namespace

void fill_uniform(const Cells& cells, std::span<double> mass) noexcept {
  fill_free_cells(cells, mass, [](Point) { return 1.0; });
}

void fill_gaussian_mixture(const Cells& cells, std::span<const GaussianComponent> components,
                           std::span<double> mass) noexcept {
  fill_free_cells(cells, mass, [&](Point p) {
    double density = 0.0;
    for (const GaussianComponent& component : components) {
      const double dx = p.x_m - component.mean.x_m;
      const double dy = p.y_m - component.mean.y_m;
      const double variance = component.sigma_m * component.sigma_m;
      density += component.weight / variance * exp_negative(-(dx * dx + dy * dy) / (2.0 * variance));
    }
    return density;
  });
}

void fill_from_image(const Cells& cells, const GreyView& image, std::span<double> mass) noexcept {
  fill_free_cells(cells, mass, [&](Point p) {
    const int column = static_cast<int>(p.x_m / image.resolution_m);
    const int row = static_cast<int>(p.y_m / image.resolution_m);
    if (column >= image.width_px || row >= image.height_px) {
      return 0.0;
    }
    return static_cast<double>(image.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) +
                                            static_cast<std::size_t>(column)]);
  });
}

}  // namespace ivo::planner
