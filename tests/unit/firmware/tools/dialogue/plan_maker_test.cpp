#include "firmware/tools/dialogue/plan_maker.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "tests/support/drawn_map.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::firmware {
namespace {

class PlanMakerTest : public testing::Test {
 protected:
  PlanMakerTest() {
    problem_.map = map_.view();
    problem_.graph.spacing_m = 3.0;
    problem_.colony.generations = 2;
    problem_.agents.resize(1);
    problem_.agents[0].body.start = {1.5, 1.5};
  }
  void wait() {
    while (!maker_.done()) {
      std::this_thread::yield();
    }
  }

  test::DrawnMap map_{12, 12, 0.25};
  planner::SearchProblem problem_;
  PlanMaker maker_;
};

TEST_F(PlanMakerTest, HasNothingToDoAtFirst) {
  EXPECT_FALSE(maker_.busy());
  EXPECT_FALSE(maker_.done());
}

TEST_F(PlanMakerTest, MakesAPlannerReadyAndSaysSoOnce) {
  maker_.begin(test::shared_planner(), problem_);
  EXPECT_TRUE(maker_.busy());
  wait();
  EXPECT_FALSE(maker_.refusal());
  EXPECT_FALSE(maker_.busy());
  EXPECT_FALSE(maker_.done()) << "once";
  const planner::Plan& plan = test::plan_of(test::shared_planner());
  EXPECT_EQ(plan.paths.size(), 1U);
  EXPECT_EQ(plan.paths[0].waypoints[0], (Point{1.5, 1.5}));
}

TEST_F(PlanMakerTest, SaysWhatIsRefusedAndForgetsItWithTheNext) {
  problem_.agents[0].body.start = {-1, 1.5};
  maker_.begin(test::shared_planner(), problem_);
  wait();
  EXPECT_EQ(maker_.refusal().code, planner::RefusalCode::kStartOutsideMap);
  EXPECT_EQ(maker_.refusal().agent, 0);
  problem_.agents[0].body.start = {1.5, 1.5};
  maker_.begin(test::shared_planner(), problem_);
  wait();
  EXPECT_FALSE(maker_.refusal());
}

TEST_F(PlanMakerTest, CopiesWhatHasBeenSearchedForItGrowsOn) {
  auto searched = std::make_unique<planner::CellSet>();
  problem_.searched = searched.get();
  maker_.begin(test::shared_planner(), problem_);
  for (planner::Cell c = 0; c < 2304; ++c) {
    (void)searched->insert(c);
  }
  searched.reset();
  wait();
  EXPECT_FALSE(maker_.refusal()) << "nothing had been searched when it was asked";
}

TEST_F(PlanMakerTest, BegunAgainOrEndedWhileItIsBusyItWaits) {
  {
    PlanMaker maker;
    maker.begin(test::shared_planner(), problem_);
    maker.begin(test::shared_planner(), problem_);
  }
  maker_.begin(test::shared_planner(), problem_);
  wait();
  EXPECT_FALSE(maker_.refusal());
}

}  // namespace
}  // namespace ivo::firmware
