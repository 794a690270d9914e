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

double density(const GaussianComponent& component, Point p) noexcept {
  const double dx = p.x_m - component.mean.x_m;
  const double dy = p.y_m - component.mean.y_m;
  const double variance = component.sigma_m * component.sigma_m;
  return component.weight / variance * exp_negative(-(dx * dx + dy * dy) / (2.0 * variance));
}

double value_at(const GreyView& image, Point p) noexcept {
  const double column = p.x_m / image.resolution_m;
  const double row = p.y_m / image.resolution_m;
  if (column >= image.width_px || row >= image.height_px) {
    return 0.0;
  }
  return image.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) +
                      static_cast<std::size_t>(column)];
}

void fill_uniform(const Cells& cells, std::span<double> mass) noexcept {
  fill_free_cells(cells, mass, [](Point) { return 1.0; });
}

void fill_gaussian_mixture(const Cells& cells, std::span<const GaussianComponent> components,
                           std::span<double> mass) noexcept {
  fill_free_cells(cells, mass, [&](Point p) {
    double sum = 0.0;
    for (const GaussianComponent& component : components) {
      sum += density(component, p);
    }
    return sum;
  });
}

void fill_from_image(const Cells& cells, const GreyView& image, std::span<double> mass) noexcept {
  fill_free_cells(cells, mass, [&](Point p) { return value_at(image, p); });
}

}  // namespace ivo::planner
