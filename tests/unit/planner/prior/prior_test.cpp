#include "planner/prior/prior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

Cells& cells_of(const test::DrawnMap& map, double cell_m) {
  static Cells cells;
  EXPECT_FALSE(cells.build(map.view(), cell_m));
  return cells;
}

test::DrawnMap map_with_a_pond() {
  test::DrawnMap map(40.0, 40.0, 0.5);
  map.put(SemanticClass::kWater, 4.0, 4.0, 6.0, 6.0);
  return map;
}

template <class Fill>
std::vector<double> filled(const Cells& cells, Fill&& fill) {
  std::vector<double> mass(static_cast<std::size_t>(cells.count()), -1.0);
  fill(mass);
  return mass;
}

TEST(UniformPrior, GivesEveryFreeCellTheSameAndObstaclesNothing) {
  const Cells& cells = cells_of(map_with_a_pond(), 0.5);
  const std::vector<double> mass = filled(cells, [&](auto& m) { fill_uniform(cells, m); });
  for (Cell c = 0; c < cells.count(); ++c) {
    ASSERT_EQ(mass[static_cast<std::size_t>(c)], cells.obstacle(c) ? 0.0 : 1.0);
  }
}

TEST(GaussianPrior, IsTheDensityAtTheCellsCentre) {
  const Cells& cells = cells_of(map_with_a_pond(), 0.5);
  const std::vector<GaussianComponent> components = {{{12.0, 30.0}, 3.0, 2.0}, {{30.0, 12.0}, 1.5, 1.0}};
  const std::vector<double> mass = filled(cells, [&](auto& m) { fill_gaussian_mixture(cells, components, m); });
  for (Cell c = 0; c < cells.count(); ++c) {
    double expected = 0.0;
    for (const GaussianComponent& g : components) {
      const double d = std::hypot(cells.centre(c).x_m - g.mean.x_m, cells.centre(c).y_m - g.mean.y_m) / g.sigma_m;
      expected += g.weight / (g.sigma_m * g.sigma_m) * std::exp(-0.5 * d * d);
    }
    ASSERT_NEAR(mass[static_cast<std::size_t>(c)], cells.obstacle(c) ? 0.0 : expected, 1e-14);
  }
}

TEST(GaussianPrior, WeighsWholeComponentsWhateverTheirWidth) {
  const Cells& cells = cells_of(map_with_a_pond(), 0.5);
  for (const double sigma_m : {1.0, 2.5}) {
    const std::vector<GaussianComponent> components = {{{11.0, 29.0}, sigma_m, 3.0}, {{29.0, 29.0}, 1.7, 1.0}};
    const std::vector<double> mass = filled(cells, [&](auto& m) { fill_gaussian_mixture(cells, components, m); });
    double left = 0.0;
    double right = 0.0;
    for (Cell c = 0; c < cells.count(); ++c) {
      (cells.centre(c).x_m < 20.0 ? left : right) += mass[static_cast<std::size_t>(c)];
    }
    EXPECT_NEAR(left / right, 3.0, 0.01);
  }
}

TEST(ImagePrior, IsThePixelUnderTheCellsCentreAndNothingOutside) {
  const Cells& cells = cells_of(map_with_a_pond(), 0.5);
  std::vector<std::uint16_t> values(10 * 8);
  std::iota(values.begin(), values.end(), std::uint16_t{1});
  const GreyView image{values, 10, 8, 3.0};  // 30 x 24 m of 40 x 40
  const std::vector<double> mass = filled(cells, [&](auto& m) { fill_from_image(cells, image, m); });
  EXPECT_EQ(mass[static_cast<std::size_t>(cells.at(0, 0))], 1.0);
  EXPECT_EQ(mass[static_cast<std::size_t>(cells.at(5, 0))], 1.0);
  EXPECT_EQ(mass[static_cast<std::size_t>(cells.at(6, 0))], 2.0);
  EXPECT_EQ(mass[static_cast<std::size_t>(cells.at(0, 6))], 11.0);
  EXPECT_EQ(mass[static_cast<std::size_t>(cells.at(59, 47))], 80.0);
  EXPECT_EQ(mass[static_cast<std::size_t>(cells.at(60, 47))], 0.0);
  EXPECT_EQ(mass[static_cast<std::size_t>(cells.at(59, 48))], 0.0);
  EXPECT_EQ(mass[static_cast<std::size_t>(cells.at(9, 9))], 0.0);  // in the pond
}

}  // namespace
}  // namespace ivo::planner
