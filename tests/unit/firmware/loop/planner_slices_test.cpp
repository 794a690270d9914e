#include "firmware/loop/planner_slices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "config/rates.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::firmware {
namespace {

bool same(const planner::Plan& a, const planner::Plan& b) {
  bool equal = a.paths.size() == b.paths.size() && a.score.expected_time_s == b.score.expected_time_s;
  for (std::size_t m = 0; equal && m < a.paths.size(); ++m) {
    equal = std::ranges::equal(a.paths[m].waypoints.span(), b.paths[m].waypoints.span());
  }
  return equal;
}

class PlannerSlicesTest : public testing::Test {
 protected:
  PlannerSlicesTest() {
    prepare(test::shared_planner(), 3, {1.5, 1.5});
    expected_ = std::make_unique<planner::Plan>(test::plan_of(test::shared_planner()));
    prepare(test::shared_planner(), 3, {1.5, 1.5});
    slices_ = std::make_unique<PlannerSlices>(test::shared_planner(), *events_, tracer_);
  }
  static planner::Planner& spare() {
    static planner::Planner planner;
    return planner;
  }
  static void prepare(planner::Planner& planner, int generations, Point start) {
    const test::DrawnMap map(12, 12, 0.25);
    planner::SearchProblem problem;
    problem.map = map.view();
    problem.graph.spacing_m = 3.0;
    problem.colony.generations = generations;
    for (const Point place : {start, Point{10.5, 1.5}}) {
      planner::SearchAgent agent;
      agent.body.start = place;
      (void)problem.agents.push_back(agent);
    }
    ASSERT_FALSE(planner.prepare(problem));
  }
  void cycle() {
    slices_->run(now_, nullptr, now_);
    now_ += rates::kCycle;
  }
  bool run_until_ready() {
    for (int i = 0; i < 100'000 && !slices_->ready(); ++i) {
      cycle();
    }
    return slices_->ready();
  }

  std::unique_ptr<EventRing> events_ = std::make_unique<EventRing>();
  Tracer tracer_;
  std::unique_ptr<PlannerSlices> slices_;
  std::unique_ptr<planner::Plan> expected_;
  Instant now_{};
};

TEST_F(PlannerSlicesTest, MakeThePlanThatIsMadeInOneGo) {
  EXPECT_EQ(slices_->number(), 1U);
  EXPECT_FALSE(slices_->ready());
  EXPECT_EQ(slices_->shown().number, 0U) << "none is shown yet";
  ASSERT_TRUE(run_until_ready());
  EXPECT_TRUE(same(slices_->plan(), *expected_));
  EXPECT_TRUE(same(slices_->shown().plan, *expected_));
  EXPECT_EQ(slices_->shown().number, 1U);
  EXPECT_TRUE(slices_->shown().ready);
}

TEST_F(PlannerSlicesTest, HeldTheyThinkNothingAndGoBackToWhereTheyWere) {
  for (int i = 0; i < 5; ++i) {
    cycle();
  }
  ASSERT_FALSE(slices_->ready());
  slices_->hold();
  const std::int64_t units = slices_->units();
  for (int i = 0; i < 100; ++i) {
    cycle();
  }
  EXPECT_EQ(slices_->units(), units);
  EXPECT_TRUE(slices_->held());
  slices_->go_back();
  ASSERT_TRUE(run_until_ready());
  EXPECT_EQ(slices_->number(), 1U);
  EXPECT_TRUE(same(slices_->plan(), *expected_));
}

TEST_F(PlannerSlicesTest, APlanThatIsReadyIsNotWhileTheyAreHeldAndIsAgainAfterwards) {
  ASSERT_TRUE(run_until_ready());
  slices_->hold();
  EXPECT_FALSE(slices_->ready());
  EXPECT_FALSE(slices_->newer());
  slices_->go_back();
  EXPECT_TRUE(slices_->ready());
  EXPECT_TRUE(same(slices_->plan(), *expected_));
}

TEST_F(PlannerSlicesTest, BegunAnewTheyLeaveThePlanThatIsFollowedAsItIs) {
  ASSERT_TRUE(run_until_ready());
  EXPECT_TRUE(slices_->newer()) << "nobody follows it yet";
  slices_->follow();
  EXPECT_FALSE(slices_->newer());
  const planner::Plan& followed = slices_->plan();
  for (std::uint32_t number = 2; number < 6; ++number) {
    slices_->hold();
    prepare(spare(), 2, {4.5, 1.5 + number});
    slices_->begin_anew(spare());
    EXPECT_EQ(slices_->number(), number);
    EXPECT_FALSE(slices_->ready());
    EXPECT_FALSE(slices_->held());
    ASSERT_TRUE(run_until_ready());
    EXPECT_TRUE(slices_->newer());
    EXPECT_NE(&slices_->plan(), &followed);
    EXPECT_EQ(slices_->plan().paths[0].waypoints[0], (Point{4.5, 1.5 + number}));
    EXPECT_EQ(slices_->shown().number, number);
    ASSERT_TRUE(same(followed, *expected_)) << "whoever follows it reads it on";
  }
  const planner::Plan newest = slices_->plan();
  slices_->follow();
  EXPECT_FALSE(slices_->newer());
  slices_->hold();
  prepare(spare(), 2, {7.5, 7.5});
  slices_->begin_anew(spare());
  const planner::Plan& other = slices_->plan();
  ASSERT_TRUE(run_until_ready());
  EXPECT_FALSE(same(other, newest));
}

TEST_F(PlannerSlicesTest, BegunAnewTheyMakeThePlanThatIsMadeInOneGo) {
  prepare(spare(), 3, {1.5, 1.5});
  for (int i = 0; i < 5; ++i) {
    cycle();
  }
  slices_->hold();
  slices_->begin_anew(spare());
  ASSERT_TRUE(run_until_ready());
  EXPECT_TRUE(same(slices_->plan(), *expected_));
}

TEST_F(PlannerSlicesTest, EndedHereTheBestPlanSoFarIsThePlan) {
  prepare(test::shared_planner(), 100'000, {1.5, 1.5});
  slices_->end_here(now_);
  EXPECT_FALSE(slices_->ready()) << "there is none yet";
  while (!slices_->progress().has_plan) {
    cycle();
  }
  slices_->hold();
  slices_->end_here(now_);
  slices_->go_back();
  EXPECT_FALSE(slices_->ready()) << "not of one that is to be made anew";
  slices_->end_here(now_);
  ASSERT_TRUE(slices_->ready());
  EXPECT_TRUE(slices_->shown().ready);
  EXPECT_EQ(slices_->plan().score.expected_time_s, slices_->progress().best.expected_time_s);
  const std::int64_t units = slices_->units();
  slices_->end_here(now_);
  EXPECT_TRUE(slices_->ready());
  EXPECT_EQ(slices_->units(), units);
}

TEST_F(PlannerSlicesTest, ShowABetterPlanAtMostFourTimesASecond) {
  prepare(test::shared_planner(), 2000, {1.5, 1.5});
  now_ = Instant(std::chrono::seconds(1));
  int shown = 0;
  int generation = -1;
  double expected_time_s = 1e9;
  Instant shown_at{};
  while (!slices_->ready() && shown < 4) {
    const Instant at = now_;
    cycle();
    const ShownPlan& plan = slices_->shown();
    if (plan.number == 1 && plan.generation != generation && !plan.ready) {
      EXPECT_GE(at - shown_at, PlannerSlices::kShownEvery);
      EXPECT_LE(plan.plan.score.expected_time_s, expected_time_s);
      shown_at = at;
      generation = plan.generation;
      expected_time_s = plan.plan.score.expected_time_s;
      ++shown;
    }
  }
  EXPECT_GE(shown, 1);
}

TEST_F(PlannerSlicesTest, APlanThatIsTakenOverIsReadyWithoutAThought) {
  slices_->take_over(*expected_);
  EXPECT_TRUE(slices_->ready());
  EXPECT_TRUE(same(slices_->shown().plan, *expected_));
  slices_->follow();
  slices_->hold();
  prepare(spare(), 2, {4.5, 4.5});
  const planner::Plan& followed = slices_->plan();
  slices_->begin_anew(spare());
  ASSERT_TRUE(run_until_ready());
  EXPECT_EQ(slices_->number(), 2U);
  EXPECT_TRUE(same(followed, *expected_));
}

}  // namespace
}  // namespace ivo::firmware
