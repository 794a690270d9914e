// The prior over what can be observed: model.md, "Sensing and expected time".
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/agreement.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using enum SemanticClass;

class ObservableMassTest : public testing::Test {
 protected:
  ObservableMassTest() {
    problem_.cell_m = 0.5;
    problem_.graph.spacing_m = 2.0;
    problem_.agents.resize(2);
    problem_.agents[0].body.start = {1.0, 1.0};
    problem_.agents[1].body.start = {3.0, 1.0};
  }

  Refusal prepare() {
    problem_.map = map_.view();
    return planner_.prepare(problem_);
  }

  test::DrawnMap map_{16.0, 8.0, 0.5};
  SearchProblem problem_;
  Planner& planner_ = test::shared_planner();
};

TEST_F(ObservableMassTest, SumsToOneOverFreeCells) {
  map_.put(kWater, 4.0, 4.0, 6.0, 6.0);
  ASSERT_FALSE(prepare());
  const Belief& belief = planner_.belief();
  EXPECT_EQ(belief.mass_cell_count, 512 - 16);
  EXPECT_NEAR(belief.unobservable_share, 0.0, 1e-12);
  double sum = 0.0;
  for (const Cell c : belief.cells_with_mass()) {
    EXPECT_FALSE(planner_.cells().obstacle(c));
    sum += to_double(belief.mass[static_cast<std::size_t>(c)]);
  }
  EXPECT_NEAR(sum, 1.0, test::sum_agreement(belief.mass_cell_count));
}

TEST_F(ObservableMassTest, LeavesOutWhatNobodyCanSeeAndSaysHowMuchThatIs) {
  map_.put(kWall, 11.5, 0.0, 12.0, 8.0);  // behind it: 4 of 15.5 m
  ASSERT_FALSE(prepare());
  const Belief& belief = planner_.belief();
  EXPECT_NEAR(belief.unobservable_share, 4.0 / 15.5, 1e-12);
  EXPECT_EQ(belief.mass_cell_count, 23 * 16);
  for (Cell c = 0; c < belief.cells; ++c) {
    const double expected = planner_.cells().centre(c).x_m < 11.5 ? 1.0 / (23 * 16) : 0.0;
    ASSERT_NEAR(to_double(belief.mass[static_cast<std::size_t>(c)]), expected, test::kMassAgreement);
  }
}

TEST_F(ObservableMassTest, TakesForTheSubPriorsTimeFourSweepsOfWhatIsObservable) {
  ASSERT_FALSE(prepare());
  EXPECT_EQ(planner_.belief().sub_prior_steps, std::ceil(4 * 128.0 / (2 * 2 * 2.5 * 0.5)));
  problem_.agents[0].speed_mps = 1.5;
  problem_.agents[1].sight_radius_m = 2.0;
  ASSERT_FALSE(prepare());
  EXPECT_EQ(planner_.belief().sub_prior_steps, std::ceil(4 * 128.0 / (2 * (2.5 * 1.5 + 2.0 * 0.5))));
}

TEST_F(ObservableMassTest, IsRefusedWhereThePriorHasNone) {
  const std::vector<std::uint16_t> black(32, 0);
  problem_.prior = GreyView{black, 8, 4, 2.0};
  EXPECT_EQ(prepare().code, RefusalCode::kPriorWithoutMass);
}

TEST_F(ObservableMassTest, IsRefusedByAgentWhereAnAgentCanSeeNone) {
  map_.put(kWall, 7.5, 0.0, 8.0, 8.0);
  problem_.agents[1].body.start = {15.0, 1.0};
  std::vector<std::uint16_t> left_only(32, 0);
  left_only[0] = left_only[9] = 7;
  problem_.prior = GreyView{left_only, 8, 4, 2.0};
  const Refusal refusal = prepare();
  EXPECT_EQ(refusal.code, RefusalCode::kNoMassObservable);
  EXPECT_EQ(refusal.agent, 1);
}

}  // namespace
}  // namespace ivo::planner
