// Cells that hold too little to count: what is left out with them, and that all sums are of what is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <vector>

#include "planner/prior/preferences.hpp"
#include "planner/prior/sub_priors.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/areas.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/masses.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using enum SemanticClass;
using test::rectangle;

// Two agents with a wall between them: everybody sees all of one side, and nothing of the other.
class NegligibleMassTest : public testing::Test {
 protected:
  NegligibleMassTest() { draw(16.0); }

  // On cells of half a metre.
  void draw(double side_m) {
    side_m_ = side_m;
    test::DrawnMap map(side_m, side_m, 0.5);
    map.put(kWall, side_m / 2 - 0.5, 0.0, side_m / 2, side_m);
    SearchProblem problem;
    problem.map = map.view();
    problem.cell_m = 0.5;
    problem.graph.spacing_m = 4.0;
    problem.agents.resize(2);
    problem.agents[0].body.start = {1.0, 1.0};
    problem.agents[1].body.start = {side_m - 1.0, 1.0};
    ASSERT_EQ(planner_.prepare(problem).code, RefusalCode::kNone);
    raw_.assign(index(cells_.count()), 0.0);
    for (Cell c = 0; c < cells_.count(); ++c) {
      raw_[index(c)] = cells_.obstacle(c) ? 0.0 : 1.0;
    }
  }
  [[nodiscard]] Cell at(double x_m, double y_m) const {
    return cells_.at(static_cast<int>(x_m / 0.5), static_cast<int>(y_m / 0.5));
  }
  /// `raw` to each free cell of a rectangle.
  void put(double raw, double x0_m, double y0_m, double x1_m, double y1_m) {
    for (Cell c = 0; c < cells_.count(); ++c) {
      const Point p = cells_.centre(c);
      if (!cells_.obstacle(c) && p.x_m > x0_m && p.x_m < x1_m && p.y_m > y0_m && p.y_m < y1_m) {
        raw_[index(c)] = raw;
      }
    }
  }
  /// What counts as nothing: of the mean of all cells, or of all.
  [[nodiscard]] double negligible() const {
    const double sum = std::accumulate(raw_.begin(), raw_.end(), 0.0);
    return sum * std::max(1e-5 / cells_.count(), 0x1p-32);
  }
  Refusal normalise() { return planner::normalise(cells_, sight_, 2, raw_, *belief_); }
  Refusal divide(const Area& of_first, const Area& of_second) {
    PreferredAreas preferred;
    preferred.resize(2);
    EXPECT_TRUE(preferred[0].push_back(of_first));
    EXPECT_TRUE(preferred[1].push_back(of_second));
    return planner::divide(cells_, sight_, preferred, *belief_, left_without_);
  }

  [[nodiscard]] static double sum_of(const std::array<Mass, limits::kCells>& masses, const Belief& belief) {
    double sum = 0.0;
    for (Cell c = 0; c < belief.cells; ++c) {
      sum += to_double(masses[index(c)]);
    }
    return sum;
  }
  // Sums are exact, and of the cells that count.
  void expect_sums() const {
    const Belief& belief = *belief_;
    EXPECT_EQ(to_double(belief.whole), sum_of(belief.mass, belief));
    EXPECT_NEAR(to_double(belief.whole), 1.0, test::sum_agreement(belief.mass_cell_count));
    int with_mass = 0;
    for (Cell c = 0; c < belief.cells; ++c) {
      const bool holds = belief.mass[index(c)] > Mass{};
      ASSERT_EQ(belief.without_mass.test(cells_.column(c), cells_.row(c)), !holds);
      with_mass += holds ? 1 : 0;
      for (int m = 0; belief.has_sub_priors && m < 2; ++m) {
        ASSERT_TRUE(holds || belief.sub_mass[index(m)][index(c)] == Mass{}) << "cell " << c << ", agent " << m;
      }
    }
    EXPECT_EQ(belief.mass_cell_count, with_mass);
    if (belief.has_sub_priors) {
      double both = 0.0;
      for (int m = 0; m < 2; ++m) {
        const double sum = sum_of(belief.sub_mass[index(m)], belief);
        EXPECT_NEAR(sum, 0.5, test::sum_agreement(belief.mass_cell_count)) << "agent " << m;
        both += sum;
      }
      EXPECT_EQ(to_double(belief.sub_whole), both);
    }
  }

  double side_m_ = 0.0;
  Planner& planner_ = test::shared_planner();
  const Cells& cells_ = planner_.cells();
  const SightTable& sight_ = planner_.sight();
  std::vector<double> raw_;
  std::unique_ptr<Belief> belief_ = std::make_unique<Belief>();
  AgentSet left_without_ = 0;
};

// On the larger map what counts is what fixed point can hold.
TEST_F(NegligibleMassTest, EndsAtTheSameCellsInBothBuilds) {
  for (const double side_m : {16.0, 128.0}) {
    draw(side_m);
    const double limit = negligible();
    put(0.999 * limit, 1.0, 1.0, 3.0, 3.0);
    put(1.001 * limit, 4.0, 1.0, 6.0, 3.0);
    put(0.0, 1.0, 4.0, 3.0, 6.0);
    ASSERT_NEAR(negligible(), limit, 0.1 * limit);
    put(0.999 * negligible(), 1.0, 1.0, 3.0, 3.0);
    put(1.001 * negligible(), 4.0, 1.0, 6.0, 3.0);
    ASSERT_FALSE(normalise());
    const auto free = std::count_if(raw_.begin(), raw_.end(), [](double raw) { return raw > 0.0; });
    EXPECT_EQ(belief_->mass_cell_count, free - 16);
    EXPECT_EQ(belief_->mass[index(at(2.0, 2.0))], Mass{});
    EXPECT_GT(belief_->mass[index(at(5.0, 2.0))], Mass{});
    EXPECT_NEAR(belief_->unobservable_share, 0.0, 1e-12);  // negligible, but seen by somebody
    expect_sums();
  }
}

TEST_F(NegligibleMassTest, IsNoneForAnAgentThatSeesNoOther) {
  put(1e-9, 8.0, 0.0, 16.0, 16.0);
  const Refusal refusal = normalise();
  EXPECT_EQ(refusal.code, RefusalCode::kNoMassObservable);
  EXPECT_EQ(refusal.agent, 1);
  put(1.0, 15.0, 15.0, 16.0, 16.0);  // four cells are enough
  EXPECT_FALSE(normalise());
  expect_sums();
}

TEST_F(NegligibleMassTest, IsNoPartOfASubPriorFromAreas) {
  const Area left = rectangle(0.0, 0.0, 8.0, 16.0);
  const Area right = rectangle(8.0, 0.0, 12.0, 16.0);
  ASSERT_FALSE(normalise());
  ASSERT_FALSE(divide(left, right));
  expect_sums();
  EXPECT_NEAR(to_double(belief_->sub_mass[1][index(at(9.0, 4.0))]), 0.5 / (256 + 128), test::kMassAgreement);

  put(1e-9, 8.0, 0.0, 16.0, 8.0);  // half of what the second agent sees, and of what it prefers
  ASSERT_FALSE(normalise());
  ASSERT_FALSE(divide(left, right));
  expect_sums();
  EXPECT_EQ(left_without_, 0);
  EXPECT_EQ(belief_->sub_mass[1][index(at(9.0, 4.0))], Mass{});
  EXPECT_NEAR(to_double(belief_->sub_mass[1][index(at(9.0, 12.0))]), 0.5 / (128 + 64), test::kMassAgreement);
}

TEST_F(NegligibleMassTest, IsNothingForAnAreaToCover) {
  put(1e-9, 8.0, 0.0, 16.0, 8.0);
  ASSERT_FALSE(normalise());
  const Refusal refusal = divide(rectangle(0.0, 0.0, 8.0, 16.0), rectangle(8.0, 0.0, 16.0, 7.0));
  EXPECT_EQ(refusal.code, RefusalCode::kAreaWithoutMass);
  EXPECT_EQ(refusal.agent, 1);
  EXPECT_EQ(refusal.area, 0);
}

TEST_F(NegligibleMassTest, IsNoPartOfASubPriorThatIsGiven) {
  put(1e-9, 8.0, 0.0, 16.0, 8.0);
  ASSERT_FALSE(normalise());
  const std::vector<std::uint16_t> even = {1};
  const std::vector<std::uint16_t> lower = {65'535, 0};
  const std::array<GreyView, 2> images = {GreyView{even, 1, 1, 16.0}, GreyView{lower, 1, 2, 8.0}};
  // The second image is of 8 x 16 m on the left: the agent on the right sees nothing of it.
  ASSERT_FALSE(give_sub_priors(cells_, sight_, SubPriorImages{images}, {}, *belief_, left_without_));
  expect_sums();
  EXPECT_EQ(left_without_, agent_bit(1));

  const std::vector<std::uint16_t> lower_right = {65'535, 65'535, 0, 1};
  const std::array<GreyView, 2> others = {GreyView{even, 1, 1, 16.0}, GreyView{lower_right, 2, 2, 8.0}};
  ASSERT_FALSE(give_sub_priors(cells_, sight_, SubPriorImages{others}, {}, *belief_, left_without_));
  expect_sums();
  EXPECT_EQ(left_without_, 0);
  EXPECT_NEAR(to_double(belief_->sub_mass[1][index(at(12.0, 12.0))]), 0.5 / 256, test::kMassAgreement);
}

// A component that is nothing beside the others has its agent search its tails, whatever its weight is a number of.
TEST_F(NegligibleMassTest, OfADealtComponentIsScaledHoweverLittleItIs) {
  for (const double weight : {1e-3, 1e-12, 1e-300, 1e-309, 5e-324, 0.0}) {
    SCOPED_TRACE(weight);
    const std::vector<GaussianComponent> gaussians = {{{4.0, 8.0}, 6.0, 1.0}, {{15.0, 8.0}, 1.0, weight}};
    const std::vector<std::int8_t> dealt = {0, 1};
    fill_gaussian_mixture(cells_, gaussians, raw_);
    ASSERT_FALSE(normalise());
    ASSERT_FALSE(give_sub_priors(cells_, sight_, DealtComponents{dealt}, gaussians, *belief_, left_without_));
    expect_sums();
    EXPECT_EQ(left_without_, weight > 1e-300 ? AgentSet{0} : left_without_);
    EXPECT_EQ(in(left_without_, 1), belief_->sub_mass[1][index(at(4.0, 8.0))] > Mass{});
  }
}

}  // namespace
}  // namespace ivo::planner
