#include "firmware/tools/colonies.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <span>
#include <thread>
#include <vector>

#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::firmware {
namespace {

const planner::SearchProblem& m1(planner::Profile profile) {
  static const std::array<planner::GaussianComponent, 2> two = {{{{12.0, 12.0}, 4.0, 1.0}, {{30.0, 28.0}, 4.0, 1.0}}};
  static test::M1 m1(30);
  m1.problem().cell_m = 0.5;
  m1.problem().prior = std::span<const planner::GaussianComponent>(two);
  m1.problem().colony.profile = profile;
  return m1.problem();
}

struct Found {
  planner::PlanScore score;
  std::vector<Point> waypoints;
  planner::Progress progress;
};

Found found_by(int count, const planner::SearchProblem& problem) {
  planner::Planner& planner = test::shared_planner();
  Result<Colonies> colonies = Colonies::create(planner, count);
  EXPECT_TRUE(colonies.ok());
  EXPECT_FALSE(planner.prepare(problem));
  colonies.value().start();
  Found found;
  while (!colonies.value().search_on().done) {
  }
  static planner::Plan plan;
  colonies.value().best_plan(plan);
  found.score = plan.score;
  found.progress = colonies.value().progress();
  for (const planner::AgentPath& path : plan.paths) {
    found.waypoints.insert(found.waypoints.end(), path.waypoints.begin(), path.waypoints.end());
  }
  return found;
}

/// Threads that take the processors away from a search.
class Load {
 public:
  Load() {
    for (std::jthread& thread : threads_) {
      thread = std::jthread([this] {
        while (!over_) {
        }
      });
    }
  }
  ~Load() { over_ = true; }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  std::atomic<bool> over_ = false;
  std::array<std::jthread, 4> threads_;
};

void expect_same(const Found& a, const Found& b) {
  EXPECT_EQ(a.score.expected_time_s, b.score.expected_time_s);
  EXPECT_EQ(a.waypoints, b.waypoints);
}

class BothProfiles : public testing::TestWithParam<planner::Profile> {};

TEST_P(BothProfiles, OneColonyFindsWhatThePlannerFinds) {
  const planner::SearchProblem& problem = m1(GetParam());
  const Found one = found_by(1, problem);
  planner::Planner& planner = test::shared_planner();
  ASSERT_FALSE(planner.prepare(problem));
  while (!planner.step({777}).done) {
  }
  static planner::Plan plan;
  planner.best_plan(plan);
  EXPECT_EQ(one.score.expected_time_s, plan.score.expected_time_s);
  EXPECT_EQ(one.score.expected_time_continuous_s, plan.score.expected_time_continuous_s);
}

TEST_P(BothProfiles, FindTheSameHoweverBusyTheMachineIs) {
  const planner::SearchProblem& problem = m1(GetParam());
  const Found quiet = found_by(3, problem);
  const Load load;
  expect_same(quiet, found_by(3, problem));
  expect_same(quiet, found_by(3, problem));
}

TEST_P(BothProfiles, MoreOfThemNeverFindLess) {
  const planner::SearchProblem& problem = m1(GetParam());
  const Found one = found_by(1, problem);
  const Found four = found_by(4, problem);
  EXPECT_EQ(four.progress.generation, 30);
  EXPECT_EQ(four.progress.generations, 30);
  const double planner::PlanScore::*const cost = GetParam() == planner::Profile::kPaper
                                                     ? &planner::PlanScore::expected_time_s
                                                     : &planner::PlanScore::expected_time_continuous_s;
  EXPECT_LE(four.score.*cost, one.score.*cost);
}

INSTANTIATE_TEST_SUITE_P(Colonies, BothProfiles, testing::Values(planner::Profile::kPaper, planner::Profile::kFast));

TEST(Colonies, ManyFindMoreThanOne) {
  const planner::SearchProblem& problem = m1(planner::Profile::kFast);
  const Found one = found_by(1, problem);
  const Found many = found_by(6, problem);
  EXPECT_NE(one.waypoints, many.waypoints);
  EXPECT_LT(many.score.expected_time_continuous_s, one.score.expected_time_continuous_s);
}

TEST(Colonies, TheBestSoFarOnlyGetsBetter) {
  planner::Planner& planner = test::shared_planner();
  Result<Colonies> colonies = Colonies::create(planner, 2);
  ASSERT_TRUE(colonies.ok());
  ASSERT_FALSE(planner.prepare(m1(planner::Profile::kFast)));
  colonies.value().start();
  planner::Progress before = colonies.value().progress();
  EXPECT_FALSE(before.has_plan);
  while (!before.done) {
    const planner::Progress now = colonies.value().search_on();
    ASSERT_GE(now.generation, before.generation);
    if (before.has_plan) {
      ASSERT_TRUE(now.has_plan);
      ASSERT_GE(now.best.complete, before.best.complete);
      if (before.best.complete) {
        ASSERT_LE(now.best.expected_time_continuous_s, before.best.expected_time_continuous_s);
      }
    }
    before = now;
  }
}

}  // namespace
}  // namespace ivo::firmware
