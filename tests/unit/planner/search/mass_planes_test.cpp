#include "planner/search/mass_planes.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/areas.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

MassPlanes& planes() {
  static MassPlanes planes;  // large
  return planes;
}

void prepare(const PriorChoice& prior) {
  test::M1 m1(1);
  m1.problem().prior = prior;
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  const Belief& belief = test::shared_planner().belief();
  planes().build(test::shared_planner().cells(), belief, belief.mass);
}

// Columns and rows, the last ones excluded.
struct Box {
  int first_column, first_row, end_column, end_row;
};

double exact_sum(const Box& box) {
  const Planner& planner = test::shared_planner();
  double sum = 0.0;
  for (int row = box.first_row; row < box.end_row; ++row) {
    for (int column = box.first_column; column < box.end_column; ++column) {
      sum += to_double(planner.belief().mass[index(planner.cells().at(column, row))]);
    }
  }
  return sum;
}

// By windows of 64 columns, as a look reads them.
double planes_sum(const Box& box) {
  Mass sum{};
  for (int row = box.first_row; row < box.end_row; ++row) {
    for (int first = box.first_column / 64 * 64; first < box.end_column; first += 64) {
      std::uint64_t word = 0;
      for (int column = std::max(first, box.first_column); column < std::min(first + 64, box.end_column); ++column) {
        word |= std::uint64_t{1} << static_cast<unsigned>(column - first);
      }
      sum += planes().of(row, first / 8, word);
    }
  }
  return to_double(sum);
}

Box random_box(std::mt19937_64& random, int least, int most) {
  const Cells& cells = test::shared_planner().cells();
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  const int width = least + below(most - least + 1);
  const int height = least + below(most - least + 1);
  const int column = below(cells.columns() - width + 1);
  const int row = below(cells.rows() - height + 1);
  return {column, row, column + width, row + height};
}

TEST(MassPlanes, AreExactWhereEveryCellHasTheSameMass) {
  prepare({});
  EXPECT_EQ(planes().count(), 1);
  std::mt19937_64 random(31);
  for (int i = 0; i < 300; ++i) {
    const Box box = random_box(random, 1, 80);
    const double exact = exact_sum(box);
    EXPECT_NEAR(planes_sum(box), exact,
                1e-9 * exact + 2 * kMassUnit * (box.end_column - box.first_column) * (box.end_row - box.first_row));
  }
}

TEST(MassPlanes, AreOneAlsoWhereEqualSharesAreRounded) {
  test::M1 m1(1);
  m1.problem().agents[0].preferred.resize(1);
  m1.problem().agents[0].preferred[0] = test::rectangle(20.0, 20.0, 33.0, 37.0);
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  const Belief& belief = test::shared_planner().belief();
  for (std::size_t m = 0; m < 2; ++m) {
    planes().build(test::shared_planner().cells(), belief, belief.sub_mass[m]);
    EXPECT_EQ(planes().count(), 1) << "agent " << m;
    const Cells& cells = test::shared_planner().cells();
    EXPECT_NEAR(planes_sum({0, 0, cells.columns(), cells.rows()}), 0.5, 1e-5) << "agent " << m;
  }
}

TEST(MassPlanes, KeepSumsOverDiscSizedPartsOfGaussiansToAFewPercent) {
  const std::vector<GaussianComponent> gaussians = {{{12, 12}, 4.0, 1.0}, {{30, 28}, 2.5, 2.0}};
  prepare(std::span<const GaussianComponent>(gaussians));
  EXPECT_GT(planes().count(), 1);
  const Cells& cells = test::shared_planner().cells();
  EXPECT_NEAR(planes_sum({0, 0, cells.columns(), cells.rows()}), 1.0, 1e-6);
  std::mt19937_64 random(32);
  int compared = 0;
  double squares = 0.0;
  for (int i = 0; i < 2'000; ++i) {
    const Box box = random_box(random, 16, 24);  // about the disc of a sight radius of 2.5 m
    const double exact = exact_sum(box);
    if (exact < 0.01) {
      EXPECT_NEAR(planes_sum(box), exact, 0.001);
      continue;
    }
    ++compared;
    const double share = planes_sum(box) / exact - 1.0;
    squares += share * share;
    EXPECT_NEAR(share, 0.0, 0.05) << "columns from " << box.first_column << ", rows from " << box.first_row;
  }
  EXPECT_GT(compared, 300);
  EXPECT_LT(std::sqrt(squares / compared), 0.01);
}

}  // namespace
}  // namespace ivo::planner
