// Waypoints of any origin, scored, against an evaluator that carries the whole map step by step.
#include "planner/search/path_score.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/agreement.hpp"
#include "tests/support/masses.hpp"
#include "tests/support/naive_evaluator.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using test::kAgreement;
using test::kStepAgreement;
constexpr double kMaxUnseen = 0.3;

using Polylines = std::vector<std::vector<Point>>;

PathScorer& scorer() {
  static FirstSightings sightings;  // large
  static PathScorer scorer(sightings);
  return scorer;
}

std::vector<WaypointPath> paths_of(const SearchProblem& problem, const Polylines& polylines) {
  std::vector<WaypointPath> paths;
  for (std::size_t m = 0; m < polylines.size(); ++m) {
    paths.push_back({polylines[m], problem.agents[m].speed_mps, problem.agents[m].sight_radius_m});
  }
  return paths;
}

PlanScore score(const Planner& planner, const SearchProblem& problem, const Polylines& polylines) {
  return scorer().score(planner.cells(), planner.belief(), paths_of(problem, polylines), kMaxUnseen);
}

// The naive evaluator goes on to the last waypoint; a path ends at the sight point where it last sees something new.
std::vector<Point> cut(const Planner& planner, const WaypointPath& path, double end_s) {
  std::vector<Point> kept = {path.waypoints[0]};
  double time_s = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size() && time_s < end_s - 1e-12; ++i) {
    const Point a = path.waypoints[i - 1];
    const Point b = path.waypoints[i];
    const double duration_s = length_m(path.waypoints.subspan(i - 1, 2)) / path.speed_mps;
    const int points = sight_points(duration_s * path.speed_mps, planner.cells().cell_m());
    const double share = duration_s > 0 ? (end_s - time_s) / duration_s : 1.0;
    kept.push_back(sight_point(a, b, std::min(points, static_cast<int>(share * points + 0.5)), points));
    time_s += duration_s;
  }
  return kept;
}

void expect_agreement(const Planner& planner, const SearchProblem& problem, const Polylines& polylines) {
  const PlanScore fast = score(planner, problem, polylines);
  const Belief& belief = planner.belief();
  const auto cells = planner.cells().count();
  test::NaiveMission mission{planner.cells(), test::as_doubles(belief.mass, cells), {}, 0};
  mission.sub_prior_steps = static_cast<int>(belief.sub_prior_steps);
  Polylines kept;
  std::vector<test::NaivePath> naive_paths;
  std::vector<double> ends_s;
  for (std::size_t m = 0; m < polylines.size(); ++m) {
    ends_s.push_back(scorer().path_end_s(static_cast<int>(m)));
    kept.push_back(cut(planner, paths_of(problem, polylines)[m], ends_s.back()));
    if (belief.has_sub_priors) {
      mission.sub_priors.push_back(test::as_doubles(belief.sub_mass[m], cells));
    }
  }
  for (std::size_t m = 0; m < polylines.size(); ++m) {
    naive_paths.push_back({kept[m], problem.agents[m].speed_mps, problem.agents[m].sight_radius_m});
  }
  const test::NaiveEvaluator evaluator(std::move(mission), naive_paths);
  const PlanScore slow = evaluator.score();
  EXPECT_NEAR(fast.expected_time_s, slow.expected_time_s, kStepAgreement);
  EXPECT_NEAR(fast.expected_time_continuous_s, slow.expected_time_continuous_s, kAgreement);
  EXPECT_NEAR(fast.expected_sub_prior_time_s, slow.expected_sub_prior_time_s, kStepAgreement);
  EXPECT_NEAR(fast.unseen_mass, slow.unseen_mass, kAgreement);
  EXPECT_NEAR(fast.horizon_s, slow.horizon_s, kAgreement);
  EXPECT_EQ(fast.complete, slow.unseen_mass <= kMaxUnseen + 1e-9);
  const std::vector<double> last_new_s = evaluator.last_new_s();
  for (std::size_t m = 0; m < last_new_s.size(); ++m) {
    EXPECT_NEAR(ends_s[m], last_new_s[m], kAgreement) << "path of agent " << m;
  }
}

Polylines waypoints_of(const Plan& plan) {
  Polylines polylines;
  for (const AgentPath& path : plan.paths) {
    polylines.emplace_back(path.waypoints.begin(), path.waypoints.end());
  }
  return polylines;
}

Polylines random_polylines(const SearchProblem& problem, std::mt19937_64& random) {
  std::uniform_real_distribution<double> x_m(0.0, problem.map.width_m());
  std::uniform_real_distribution<double> y_m(0.0, problem.map.height_m());
  Polylines polylines;
  for (const SearchAgent& agent : problem.agents) {
    polylines.push_back({agent.body.start});
    for (std::uint64_t i = random() % 7; i > 0; --i) {
      polylines.back().push_back(random() % 8 == 0 ? polylines.back().back() : Point{x_m(random), y_m(random)});
    }
  }
  return polylines;
}

TEST(PathScorer, AgreesWithTheNaiveEvaluatorOnPlansAndOnRandomPolylines) {
  std::mt19937_64 random(77);
  Planner& planner = test::shared_planner();
  int searches = 0;
  int with_sub_priors = 0;
  int complete = 0;
  for (int draw = 0; searches < 40; ++draw) {
    ASSERT_LT(draw, 400);
    test::RandomSearch search(random);
    if (planner.prepare(search.problem())) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    const Plan& plan = test::plan_of(planner);
    expect_agreement(planner, search.problem(), waypoints_of(plan));
    const PlanScore again = score(planner, search.problem(), waypoints_of(plan));
    EXPECT_NEAR(again.expected_time_s, plan.score.expected_time_s, kStepAgreement);
    EXPECT_NEAR(again.expected_time_continuous_s, plan.score.expected_time_continuous_s, kAgreement);
    EXPECT_NEAR(again.expected_sub_prior_time_s, plan.score.expected_sub_prior_time_s, kStepAgreement);
    EXPECT_NEAR(again.unseen_mass, plan.score.unseen_mass, kAgreement);
    for (int i = 0; i < 3; ++i) {
      const Polylines polylines = random_polylines(search.problem(), random);
      expect_agreement(planner, search.problem(), polylines);
      complete += score(planner, search.problem(), polylines).complete ? 1 : 0;
    }
    with_sub_priors += planner.belief().has_sub_priors ? 1 : 0;
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(with_sub_priors, 8);
  EXPECT_GT(complete, 3);
}

TEST(PathScorer, AgreesWithTheNaiveEvaluatorOnTheOwnReadingOfSubPriors) {
  std::mt19937_64 random(78);
  Planner& planner = test::shared_planner();
  int searches = 0;
  for (int draw = 0; searches < 12; ++draw) {
    ASSERT_LT(draw, 400);
    test::RandomSearch search(random);
    if (planner.prepare(search.problem()) || !planner.belief().has_sub_priors) {
      continue;
    }
    ++searches;
    SCOPED_TRACE("draw " + std::to_string(draw));
    const Polylines polylines = random_polylines(search.problem(), random);
    const Belief& belief = planner.belief();
    const auto cells = planner.cells().count();
    test::NaiveMission mission{planner.cells(), test::as_doubles(belief.mass, cells), {}, 0};
    mission.sub_prior_steps = belief.sub_prior_steps;
    mission.reading = test::SubPriorReading::kOwn;
    std::vector<test::NaivePath> paths;
    for (std::size_t m = 0; m < polylines.size(); ++m) {
      mission.sub_priors.push_back(test::as_doubles(belief.sub_mass[m], cells));
      paths.push_back({polylines[m], search.problem().agents[m].speed_mps, search.problem().agents[m].sight_radius_m});
    }
    const double slow_s = test::NaiveEvaluator(std::move(mission), paths).score().expected_sub_prior_time_s;
    EXPECT_NEAR(score(planner, search.problem(), polylines).expected_sub_prior_time_own_s, slow_s, kStepAgreement);
  }
}

TEST(PathScorer, CountsNothingOfAPathThatOnlyGoesBack) {
  const test::DrawnMap map(20, 6, 0.25);
  SearchProblem problem;
  problem.map = map.view();
  problem.agents.resize(1);
  problem.agents[0].body.start = {2, 3};
  Planner& planner = test::shared_planner();
  ASSERT_FALSE(planner.prepare(problem));
  const PlanScore there = score(planner, problem, {{{2, 3}, {9, 3}}});
  const PlanScore and_back = score(planner, problem, {{{2, 3}, {9, 3}, {2, 3}}});
  EXPECT_EQ(and_back.horizon_s, there.horizon_s);
  EXPECT_EQ(and_back.expected_time_s, there.expected_time_s);
  EXPECT_EQ(and_back.expected_time_continuous_s, there.expected_time_continuous_s);
  EXPECT_FALSE(there.complete);
}

}  // namespace
}  // namespace ivo::planner
