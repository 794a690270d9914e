// Where somebody has looked and not found it, a plan that is made anew expects nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "config/limits.hpp"
#include "planner/numeric/index.hpp"
#include "planner/numeric/scalar.hpp"
#include "planner/world/cell_set.hpp"
#include "tests/support/areas.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

TEST(CellSet, HoldsWhatWasInsertedAndSaysWhetherItIsNew) {
  const auto set = std::make_unique<CellSet>();
  for (const Cell c : {0, 1, 63, 64, 65, 1000, limits::kCells - 1}) {
    EXPECT_FALSE(set->contains(c));
    EXPECT_TRUE(set->insert(c));
    EXPECT_FALSE(set->insert(c));
    EXPECT_TRUE(set->contains(c));
  }
  EXPECT_FALSE(set->contains(2));
  EXPECT_FALSE(set->contains(62));
  EXPECT_EQ(set->words()[0], std::uint64_t{1} << 63 | 3U);
  EXPECT_EQ(set->words()[1], 3U);
}

class SearchedCellsTest : public testing::Test {
 protected:
  SearchedCellsTest() : searched_(std::make_unique<CellSet>()) {
    problem_.map = map_.view();
    problem_.graph.spacing_m = 3.0;
    problem_.colony.generations = 2;
    problem_.agents.resize(1);
    problem_.agents[0].body.start = {1.5, 1.5};
    problem_.searched = searched_.get();
  }
  void search_west_of(double x_m) {
    EXPECT_FALSE(planner_.prepare(problem_));
    for (Cell c = 0; c < planner_.cells().count(); ++c) {
      if (planner_.cells().centre(c).x_m < x_m) {
        (void)searched_->insert(c);
      }
    }
  }

  test::DrawnMap map_{12, 12, 0.25};
  std::unique_ptr<CellSet> searched_;
  SearchProblem problem_;
  Planner& planner_ = test::shared_planner();
};

TEST_F(SearchedCellsTest, NoCellSearchedIsAsNoneGiven) {
  problem_.searched = nullptr;
  ASSERT_FALSE(planner_.prepare(problem_));
  const std::vector<Mass> expected(planner_.belief().mass.begin(),
                                   planner_.belief().mass.begin() + planner_.cells().count());
  problem_.searched = searched_.get();
  ASSERT_FALSE(planner_.prepare(problem_));
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), planner_.belief().mass.begin()));
}

TEST_F(SearchedCellsTest, HoldNoMassAndTheOthersHoldAllOfIt) {
  search_west_of(8.0);
  ASSERT_FALSE(planner_.prepare(problem_));
  double sum = 0.0;
  double share = 0.0;
  for (Cell c = 0; c < planner_.cells().count(); ++c) {
    const double mass = to_double(planner_.belief().mass[index(c)]);
    sum += mass;
    if (searched_->contains(c)) {
      ASSERT_EQ(mass, 0.0) << c;
    } else {
      ASSERT_TRUE(share == 0.0 || std::abs(mass - share) < 1e-6) << "as probable as before among each other";
      share = mass;
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  EXPECT_GT(share, 0.0);
}

TEST_F(SearchedCellsTest, APlanGoesWhereSomethingIsLeft) {
  search_west_of(8.0);
  ASSERT_FALSE(planner_.prepare(problem_));
  const Plan& plan = test::plan_of(planner_);
  EXPECT_GT(plan.paths[0].waypoints.back().x_m, 5.0);
  EXPECT_LT(plan.score.unseen_mass, 0.1);
}

TEST_F(SearchedCellsTest, NothingLeftIsRefused) {
  search_west_of(100.0);
  EXPECT_EQ(planner_.prepare(problem_).code, RefusalCode::kPriorWithoutMass);
}

TEST_F(SearchedCellsTest, APreferredAreaThatIsSearchedIsRefusedByItsNumber) {
  search_west_of(8.0);
  (void)problem_.agents[0].preferred.push_back(test::rectangle(9, 1, 11, 11));
  (void)problem_.agents[0].preferred.push_back(test::rectangle(1, 1, 6, 6));
  const Refusal refusal = planner_.prepare(problem_);
  EXPECT_EQ(refusal.code, RefusalCode::kAreaWithoutMass);
  EXPECT_EQ(refusal.agent, 0);
  EXPECT_EQ(refusal.area, 1);
}

TEST_F(SearchedCellsTest, ThePlannerIsAsGoodAsNewAfterARefusal) {
  search_west_of(100.0);
  ASSERT_TRUE(planner_.prepare(problem_));
  problem_.searched = nullptr;
  ASSERT_FALSE(planner_.prepare(problem_));
  EXPECT_LT(test::plan_of(planner_).score.unseen_mass, 0.1);
}

}  // namespace
}  // namespace ivo::planner
