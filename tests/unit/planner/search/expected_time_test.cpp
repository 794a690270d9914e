#include "planner/search/expected_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace ivo::planner {
namespace {

constexpr double kRounding = kFixedPoint ? 1e-3 : 1e-12;  // the fixed-point one of a time, 2^-16 s, for each cell

// A handful of cells in a row, with numbers small enough to do by hand.
class ExpectedTimeTest : public testing::Test {
 protected:
  ExpectedTimeTest() { sightings_->clear(limits::kCells); }

  void masses(const std::vector<double>& masses) {
    belief_->cells = belief_->mass_cell_count = static_cast<int>(masses.size());
    belief_->agents = 2;
    for (std::size_t c = 0; c < masses.size(); ++c) {
      belief_->mass[c] = Mass(masses[c]);
      belief_->mass_cells[c] = static_cast<Cell>(c);
    }
  }

  void sub_prior(std::size_t agent, const std::vector<double>& masses) {
    std::transform(masses.begin(), masses.end(), belief_->sub_mass[agent].begin(), [](double p) { return Mass(p); });
  }

  void see(Cell c, int agent, double time_s) { (void)sightings_->see(c, agent, Seconds(time_s)); }

  PlanScore score(double max_unseen_mass = 0.014, int slice = 100) {
    ExpectedTime expected;
    for (int first = 0; first < belief_->mass_cell_count; first += slice) {
      expected.add(*belief_, *sightings_, first, std::min(slice, belief_->mass_cell_count - first));
    }
    return expected.score(*belief_, max_unseen_mass);
  }

  std::unique_ptr<Belief> belief_ = std::make_unique<Belief>();
  std::unique_ptr<FirstSightings> sightings_ = std::make_unique<FirstSightings>();
};

TEST_F(ExpectedTimeTest, IsZeroWhenAllIsSeenFromTheStart) {
  masses({0.5, 0.5});
  see(0, 0, 0.0);
  see(1, 1, 0.0);
  EXPECT_EQ(score().expected_time_s, 0.0);
  EXPECT_EQ(score().expected_time_continuous_s, 0.0);
  EXPECT_EQ(score().unseen_mass, 0.0);
  EXPECT_TRUE(score().complete);
}

TEST_F(ExpectedTimeTest, SumsWhatIsLeftAfterEachStep) {
  masses({0.25, 0.25, 0.5});
  see(0, 0, 0.0);
  see(1, 0, 1.5);
  see(2, 0, 3.5);
  // 1 - P after steps 1 to 4: 0.75, 0.5, 0.5, 0.
  EXPECT_NEAR(score().expected_time_s, 1.75, kRounding);
  EXPECT_NEAR(score().expected_time_continuous_s, 0.25 * 1.5 + 0.5 * 3.5, kRounding);
  EXPECT_NEAR(score().horizon_s, 3.5, kRounding);
}

TEST_F(ExpectedTimeTest, CountsWhatStaysUnseenUpToTheHorizon) {
  masses({0.5, 0.3, 0.2});
  see(0, 0, 2.0);
  see(1, 1, 4.5);
  // 1 - P after steps 1 to 5: 1, 0.5, 0.5, 0.5, 0.2.
  EXPECT_NEAR(score().expected_time_s, 2.7, kRounding);
  EXPECT_NEAR(score().expected_time_continuous_s, 0.5 * 2.0 + 0.3 * 4.5 + 0.2 * 4.5, kRounding);
  EXPECT_NEAR(score().unseen_mass, 0.2, kRounding);
  EXPECT_FALSE(score().complete);
  EXPECT_TRUE(score(0.2).complete);
  EXPECT_FALSE(score(0.199).complete);
}

TEST_F(ExpectedTimeTest, CreditsEachSubPriorWithItsOwnAgentsSightingsOverAFixedTime) {
  masses({0.5, 0.3, 0.2});
  belief_->has_sub_priors = true;
  belief_->sub_prior_steps = 10;
  sub_prior(0, {0.5, 0.0, 0.0});
  sub_prior(1, {0.0, 0.3, 0.2});
  see(0, 0, 2.0);  // its own: half is found after step 2
  see(1, 0, 3.0);  // the other's: gone unfound
  see(2, 1, 4.0);  // its own: a fifth after step 4
  // 1 - P_EST: 1, 0.5, 0.5, then 0.3 for steps 4 to 10.
  EXPECT_NEAR(score().expected_sub_prior_time_s, 2.0 + 7 * 0.3, kRounding);
  EXPECT_NEAR(score().unseen_mass, 0.0, kRounding);
}

TEST_F(ExpectedTimeTest, LeavesOutOfTheSubPriorTimeWhatIsSeenAfterItsEnd) {
  masses({0.5, 0.5});
  belief_->has_sub_priors = true;
  belief_->sub_prior_steps = 3;
  sub_prior(0, {0.5, 0.0});
  sub_prior(1, {0.0, 0.5});
  see(0, 0, 1.0);
  see(1, 1, 8.0);
  EXPECT_NEAR(score().expected_sub_prior_time_s, 1.5, kRounding);
}

TEST_F(ExpectedTimeTest, EndsAPathWhereItsAgentLastSeesSomethingNew) {
  masses({0.4, 0.3, 0.3});
  see(0, 0, 1.0);
  see(1, 0, 3.7);  // credited, for it is the lower number in that step
  see(2, 0, 9.0);  // nothing new
  see(1, 1, 3.2);
  see(2, 1, 2.0);
  ExpectedTime expected;
  expected.add(*belief_, *sightings_, 0, 3);
  EXPECT_EQ(expected.path_end_s(0), Seconds(3.7));
  EXPECT_EQ(expected.path_end_s(1), Seconds(3.2));
  expected.clear();
  EXPECT_EQ(expected.path_end_s(0), Seconds{});
}

TEST_F(ExpectedTimeTest, IsTheSameToTheBitHoweverItIsSliced) {
  std::vector<double> uneven;
  for (int c = 0; c < 97; ++c) {
    uneven.push_back(1.0 / (c + 3.0));
    see(c, c % 2, 0.37 * c);
  }
  masses(uneven);
  const PlanScore whole = score();
  for (const int slice : {1, 2, 7, 50}) {
    EXPECT_EQ(score(0.014, slice).expected_time_s, whole.expected_time_s);
    EXPECT_EQ(score(0.014, slice).expected_time_continuous_s, whole.expected_time_continuous_s);
  }
}

TEST(Completeness, IsNotDecidedByTheRoundingOfASum) {
  double down = 1.0;
  for (int i = 0; i < 986; ++i) {
    down -= 0.001;
  }
  EXPECT_TRUE(is_complete(down, 0.014));
  EXPECT_TRUE(is_complete(1.0 - 0.986, 0.014));
  EXPECT_FALSE(is_complete(0.0141, 0.014));
}

}  // namespace
}  // namespace ivo::planner
