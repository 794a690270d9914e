// The oracle itself, against sums made by hand: two agents walk a 9 m hall of 1 m cells towards each other.
#include "tests/support/naive_evaluator.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/drawn_map.hpp"

namespace ivo::planner {
namespace {

class NaiveEvaluator : public testing::Test {
 protected:
  // Each sees its own cell alone: 0.4 m of reach, half a metre a sight point. Agent 0 sees cell i at i s, agent 1,
  // twice as fast, cell 8 - i at i / 2 s.
  [[nodiscard]] PlanScore score(test::SubPriorReading reading) const {
    static Cells cells;
    static const test::DrawnMap kHall(9.0, 1.0, 1.0);
    EXPECT_FALSE(cells.build(kHall.view(), 1.0));
    test::NaiveMission mission{.cells = cells, .prior = std::vector<double>(9, 0.0), .sub_priors = {}};
    mission.prior[2] = 0.5;
    mission.prior[7] = 0.5;
    mission.sub_priors = {std::vector<double>(9, 0.0), std::vector<double>(9, 0.0)};
    mission.sub_priors[0][7] = 0.5;
    mission.sub_priors[1][2] = 0.25;
    mission.sub_priors[1][7] = 0.25;
    mission.sub_prior_steps = 10;
    mission.reading = reading;
    const std::array<Point, 2> there = {Point{0.5, 0.5}, Point{8.5, 0.5}};
    const std::array<Point, 2> back = {Point{8.5, 0.5}, Point{0.5, 0.5}};
    const std::array<test::NaivePath, 2> paths = {test::NaivePath{there, 1.0, 0.4}, test::NaivePath{back, 2.0, 0.4}};
    return test::NaiveEvaluator(mission, paths).score();
  }
};

// Cell 7 by agent 1 at 0.5 s, step 1; cell 2 by agent 0 at 2 s, step 2; the longer path ends at 8 s.
TEST_F(NaiveEvaluator, AddsUpTheExpectedTimesOfTheWholeTeam) {
  const PlanScore score = this->score(test::SubPriorReading::kTeam);
  EXPECT_DOUBLE_EQ(score.expected_time_continuous_s, 0.5 * 0.5 + 0.5 * 2.0);
  EXPECT_DOUBLE_EQ(score.expected_time_s, 0.5 * 1);
  EXPECT_DOUBLE_EQ(score.unseen_mass, 0.0);
  EXPECT_DOUBLE_EQ(score.horizon_s, 8.0);
}

// Team: agent 1 finds 0.25 in cell 7 in step 1 and takes agent 0's half away; agent 0 then finds nothing of its own in
// cell 2 and takes agent 1's quarter away. The other three quarters stay for all ten steps.
TEST_F(NaiveEvaluator, LetsAnyAgentDepleteEverySubPriorInTheTeamReading) {
  EXPECT_DOUBLE_EQ(score(test::SubPriorReading::kTeam).expected_sub_prior_time_s, 0.75 * 10);
}

// Own: agent 1 finds a quarter in step 1 and the other in cell 2 at 3 s, step 3; agent 0 its half in cell 7 at 7 s.
TEST_F(NaiveEvaluator, LetsAnAgentAloneDepleteItsSubPriorInTheOwnReading) {
  EXPECT_DOUBLE_EQ(score(test::SubPriorReading::kOwn).expected_sub_prior_time_s, 0.75 * 2 + 0.5 * 4);
}

}  // namespace
}  // namespace ivo::planner
