// Searches that make no sense, by the thousand: each is refused or planned, in bounded time, and what is planned can be
// read.
#include "tests/support/degenerate_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

void expect_sound(const Planner& planner, const SearchProblem& problem, const Plan& plan) {
  ASSERT_EQ(plan.paths.size(), problem.agents.size());
  EXPECT_TRUE(std::isfinite(plan.score.expected_time_s));
  EXPECT_TRUE(std::isfinite(plan.score.expected_time_continuous_s));
  EXPECT_TRUE(std::isfinite(plan.score.horizon_s));
  EXPECT_GE(plan.score.expected_time_s, 0.0);
  EXPECT_GE(plan.score.expected_time_continuous_s, -1e-9);
  EXPECT_GE(plan.score.unseen_mass, 0.0);
  EXPECT_LE(plan.score.unseen_mass, 1.0 + 1e-9);
  EXPECT_GE(planner.belief().unobservable_share, -1e-9);
  EXPECT_LE(planner.belief().unobservable_share, 1.0);
  for (std::size_t m = 0; m < plan.paths.size(); ++m) {
    const AgentPath& path = plan.paths[m];
    ASSERT_FALSE(path.waypoints.empty());
    EXPECT_EQ(path.waypoints[0], problem.agents[m].body.start);
    EXPECT_LE(path.duration_s, plan.score.horizon_s + 1e-9);
    for (const Point p : path.waypoints) {
      EXPECT_TRUE(problem.map.contains(p));
    }
  }
}

TEST(DegenerateSearch, IsRefusedOrPlannedAndNeverCrashesNorHangs) {
  std::mt19937_64 random(5);
  Planner& planner = test::shared_planner();
  static Plan plan;
  std::array<int, 64> refused{};
  int planned = 0;
  for (int draw = 0; draw < 12'000; ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    test::DegenerateSearch search(random);
    const SearchProblem& problem = search.problem();
    if (draw % 2 == 0) {
      search.problem().colony.profile = Profile::kPaper;
    }
    if (const Refusal refusal = planner.prepare(problem)) {
      ++refused[static_cast<std::size_t>(refusal.code)];
      EXPECT_LT(refusal.agent, static_cast<int>(problem.agents.size()));
      EXPECT_TRUE(planner.step({1000}).done);
      continue;
    }
    ++planned;
    // A plan comes within work that the search's size bounds; so does the end.
    constexpr int kSlices = 20'000;
    int slices = 0;
    while (!planner.step({5000}).done && slices < kSlices) {
      ++slices;
    }
    ASSERT_LT(slices, kSlices);
    ASSERT_TRUE(planner.progress().has_plan);
    planner.best_plan(plan);
    expect_sound(planner, problem, plan);
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(planned, 700);
  for (const RefusalCode code :
       {RefusalCode::kTooManyCells, RefusalCode::kTooManySquares, RefusalCode::kStartOutsideMap,
        RefusalCode::kStartBlocked, RefusalCode::kStartRestricted, RefusalCode::kPriorWithoutMass,
        RefusalCode::kNoMassObservable, RefusalCode::kAreaWithoutMass}) {
    EXPECT_GT(refused[static_cast<std::size_t>(code)], 0) << "code " << static_cast<int>(code);
  }
}

}  // namespace
}  // namespace ivo::planner
