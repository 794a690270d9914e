// What happens when a plan has less room than it needs: waypoints of a path, steps of EST.
#include <gtest/gtest.h>

#include <vector>

#include "planner/search/path_score.hpp"
#include "planner/world/graph_table.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

/// As many nodes as there may be, on a square grid with edges to all eight neighbours, for one agent that sees little
/// more than the cells under it: nearly every edge must be taken, and there are about four a node.
class ShortSight {
 public:
  ShortSight() {
    for (int n = 0; n < kSide * kSide; ++n) {
      const int column = n % kSide;
      const int row = n / kSide;
      positions_.push_back({(column + 0.5) * kSpacing_m, (row + 0.5) * kSpacing_m});
      first_edge_.push_back(static_cast<Edge>(heads_.size()));
      for (int to_row = row - 1; to_row <= row + 1; ++to_row) {
        for (int to_column = column - 1; to_column <= column + 1; ++to_column) {
          const bool inside = to_row >= 0 && to_row < kSide && to_column >= 0 && to_column < kSide;
          if (inside && (to_row != row || to_column != column)) {
            heads_.push_back(static_cast<Node>(to_row * kSide + to_column));
          }
        }
      }
    }
    first_edge_.push_back(static_cast<Edge>(heads_.size()));
    open_to_.assign(heads_.size(), AgentSet{1});
    table_ = {.spacing_m = kSpacing_m,
              .agents = 1,
              .positions = positions_,
              .first_edge = first_edge_,
              .heads = heads_,
              .open_to = open_to_};
    problem_.map = map_.view();
    problem_.cell_m = 1.0;
    problem_.graph.spacing_m = kSpacing_m;
    problem_.graph_table = &table_;
    problem_.agents.resize(1);
    problem_.agents[0].body.start = positions_.front();
    problem_.agents[0].sight_radius_m = 0.6;
    problem_.colony.generations = 1;  // ants alone: nothing is improved off the graph
    problem_.colony.ants = 1;
  }
  ShortSight(const ShortSight&) = delete;
  ShortSight& operator=(const ShortSight&) = delete;
  [[nodiscard]] const SearchProblem& problem() const { return problem_; }

 private:
  static constexpr int kSide = limits::kNodes >= 16'384 ? 128 : limits::kNodes >= 4'096 ? 64 : 16;
  static constexpr double kSpacing_m = 12.0;

  test::DrawnMap map_{kSide * kSpacing_m, kSide* kSpacing_m, 1.0};
  std::vector<Point> positions_;
  std::vector<Edge> first_edge_;
  std::vector<Node> heads_;
  std::vector<AgentSet> open_to_;
  GraphTable table_;
  SearchProblem problem_;
};

TEST(Horizon, APathThatIsFullEndsAPlanThatSaysItIsIncomplete) {
  const ShortSight sight;
  Planner& planner = test::shared_planner();
  ASSERT_EQ(planner.prepare(sight.problem()).code, RefusalCode::kNone);
  const Plan& plan = test::plan_of(planner);
  EXPECT_TRUE(planner.progress().done);
  EXPECT_FALSE(plan.score.complete);
  EXPECT_FALSE(planner.progress().best.complete);
  EXPECT_GT(plan.score.unseen_mass, 0.1);
  EXPECT_LT(plan.score.unseen_mass, 0.9);
  // All of it but what showed nothing new at its end.
  EXPECT_LE(plan.paths[0].waypoints.size(), static_cast<std::size_t>(limits::kWaypoints));
  EXPECT_GT(plan.paths[0].waypoints.size(), static_cast<std::size_t>(limits::kWaypoints) - 64);
}

TEST(Horizon, WhatIsFoundAfterTheStepsOfEstCountsAsNotFound) {
  test::M1 m1(1);
  m1.problem().sub_priors = AlikeSubPriors{};
  Planner& planner = test::shared_planner();
  ASSERT_EQ(planner.prepare(m1.problem()).code, RefusalCode::kNone);
  const double steps = planner.belief().sub_prior_steps;
  ASSERT_EQ(steps, 640);
  static FirstSightings sightings;  // large
  static PathScorer scorer(sightings);
  // To and fro on ground that is seen, and then to ground that is not.
  const auto score = [&](int laps) {
    std::vector<Point> way = {{1.75, 1.75}};
    for (int lap = 0; lap < laps; ++lap) {
      way.push_back({11.75, 1.75});
      way.push_back({1.75, 1.75});
    }
    way.push_back({1.75, 21.75});
    const std::vector<Point> other = {{39.25, 1.75}};
    return scorer.score(planner.cells(), planner.belief(),
                        std::vector<WaypointPath>{{way, 1.0, 2.5}, {other, 1.0, 2.5}}, 0.014);
  };
  const PlanScore soon = score(1);
  const PlanScore late = score(33);
  const PlanScore later = score(50);
  EXPECT_LT(soon.expected_sub_prior_time_s, late.expected_sub_prior_time_s);
  EXPECT_GT(late.horizon_s, steps);
  EXPECT_EQ(late.expected_sub_prior_time_s, later.expected_sub_prior_time_s);
  EXPECT_LT(late.expected_time_s, later.expected_time_s);  // ET knows no such end
  EXPECT_EQ(late.unseen_mass, later.unseen_mass);
}

}  // namespace
}  // namespace ivo::planner
