// Masses of cells one after the other: what rounding may do to each, and to sums of them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/numeric/scalar.hpp"

namespace ivo::planner {
namespace {

constexpr double kUnit = 0x1p-31;  // of fixed point

TEST(MassRounding, KeepsSumsOfCellsThatAreAlike) {
  for (const double units : {1.6, 2.5, 1073.43, 1351.499}) {
    MassRounding rounding;
    Mass sum{};
    for (int cell = 1; cell <= 100'000; ++cell) {
      const double mass = to_double(rounding.round(units * kUnit));
      ASSERT_NEAR(mass, units * kUnit, 1.0 * kMassUnit);
      sum += Mass(mass);
      ASSERT_NEAR(to_double(sum), cell * units * kUnit, 0.51 * kMassUnit * (kFixedPoint ? 1 : cell)) << units;
    }
  }
}

TEST(MassRounding, KeepsSumsOfAnyCells) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> units(1.5, 5.0);
  MassRounding rounding;
  Mass sum{};
  double exact = 0.0;
  for (int cell = 1; cell <= 100'000; ++cell) {
    const double value = units(random) * kUnit;
    exact += value;
    sum += rounding.round(value);
    ASSERT_NEAR(to_double(sum), exact, 0.51 * kMassUnit * (kFixedPoint ? 1 : cell));
  }
}

// A cell that counts is not taken for an empty one, nor an empty one for one that counts, whatever came before.
TEST(MassRounding, LeavesCellsOfAboutAUnitAlone) {
  for (const double before : {2.45, 2.55, 7.0}) {
    for (const double units : {0.0, 0.49, 0.51, 1.0, 1.49}) {
      MassRounding rounding;
      (void)rounding.round(before * kUnit);
      for (int i = 0; i < 10; ++i) {
        ASSERT_EQ(rounding.round(units * kUnit), mass_from(units * kUnit)) << units << " units after " << before;
      }
    }
  }
}

}  // namespace
}  // namespace ivo::planner
