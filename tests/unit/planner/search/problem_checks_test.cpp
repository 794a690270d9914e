// What the planner does with problems that make no sense, and with ones that hardly leave anything to do.
#include "planner/search/problem_checks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/areas.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using enum SemanticClass;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

class ProblemCheck : public testing::Test {
 protected:
  ProblemCheck() {
    problem_.map = map_.view();
    problem_.cell_m = 0.5;
    problem_.graph.spacing_m = 2.0;
    problem_.colony.generations = 5;
    problem_.agents.resize(2);
    problem_.agents[0].body.start = {1.0, 1.0};
    problem_.agents[1].body.start = {3.0, 1.0};
  }

  Refusal refusal() {
    problem_.map = map_.view();
    return planner_.prepare(problem_);
  }
  void expect(RefusalCode code, int agent = -1, int area = -1) {
    const Refusal r = planner_.prepare(problem_);
    EXPECT_EQ(r.code, code);
    EXPECT_EQ(r.agent, agent);
    EXPECT_EQ(r.area, area);
    EXPECT_TRUE(planner_.step({1000}).done);
    EXPECT_FALSE(planner_.progress().has_plan);
  }
  const Plan& plan() {
    EXPECT_EQ(refusal().code, RefusalCode::kNone);
    return test::plan_of(planner_);
  }

  test::DrawnMap map_{16.0, 8.0, 0.5};
  SearchProblem problem_;
  std::vector<GaussianComponent> gaussians_ = {{{3.0, 3.0}, 1.0, 1.0}, {{9.0, 3.0}, 1.0, 1.0}};
  Planner& planner_ = test::shared_planner();
};

TEST_F(ProblemCheck, PassesASoundProblem) { EXPECT_FALSE(check(problem_)); }

TEST_F(ProblemCheck, RefusesAMapWithoutPixelsOfASize) {
  problem_.map.width_px = 0;
  expect(RefusalCode::kMapInvalid);
  problem_.map = map_.view();
  problem_.map.height_px += 1;
  expect(RefusalCode::kMapInvalid);
  problem_.map = map_.view();
  for (const double bad : {0.0, -0.5, kNan, kInfinite}) {
    problem_.map.resolution_m = bad;
    expect(RefusalCode::kMapInvalid);
  }
}

TEST_F(ProblemCheck, RefusesCellsSquaresAndClearancesOfNoSize) {
  for (const double bad : {0.0, -0.5, kNan, kInfinite}) {
    problem_.cell_m = bad;
    expect(RefusalCode::kCellSizeInvalid);
    problem_.cell_m = 0.5;
    problem_.graph.spacing_m = bad;
    expect(RefusalCode::kSpacingInvalid);
    problem_.graph.spacing_m = 2.0;
  }
  for (const double bad : {-0.1, kNan, kInfinite}) {
    problem_.graph.clearance_m = bad;
    expect(RefusalCode::kClearanceInvalid);
  }
}

TEST_F(ProblemCheck, RefusesATeamOfNobody) {
  problem_.agents.clear();
  expect(RefusalCode::kNoAgents);
}

TEST_F(ProblemCheck, RefusesByAgentSpeedsSightsAndFootprintsThatAreNone) {
  SearchAgent& second = problem_.agents[1];
  for (const double bad : {0.0, -1.0, 1e-5, kNan, kInfinite}) {
    second.speed_mps = bad;
    expect(RefusalCode::kSpeedInvalid, 1);
  }
  second.speed_mps = 0.5;
  for (const double bad : {0.0, -1.0, 1e12, kNan, kInfinite}) {
    second.sight_radius_m = bad;
    expect(RefusalCode::kSightInvalid, 1);
  }
  second.sight_radius_m = 2.5;
  for (const double bad : {-0.1, kNan, kInfinite}) {
    second.body.footprint_radius_m = bad;
    expect(RefusalCode::kFootprintInvalid, 1);
  }
}

TEST_F(ProblemCheck, RefusesStartsThatAreNoPlace) {
  problem_.agents[1].body.start = {kNan, 1.0};
  expect(RefusalCode::kStartOutsideMap, 1);
  problem_.agents[1].body.start = {1.0, kInfinite};
  expect(RefusalCode::kStartOutsideMap, 1);
}

TEST_F(ProblemCheck, RefusesByNumberAreasThatAreNoPolygons) {
  Area broken = test::rectangle(1, 1, 3, 3);
  broken[2].x_m = kNan;
  ASSERT_TRUE(problem_.agents[1].preferred.push_back(test::rectangle(1, 1, 3, 3)));
  ASSERT_TRUE(problem_.agents[1].preferred.push_back(broken));
  expect(RefusalCode::kAreaInvalid, 1, 1);
  EXPECT_EQ(planner_.prepare(problem_).value, 0.0);
  problem_.agents[1].preferred.clear();
  broken = test::rectangle(1, 1, 3, 3);
  broken.resize(2);
  ASSERT_TRUE(problem_.agents[0].body.restricted.push_back(broken));
  expect(RefusalCode::kAreaInvalid, 0, 0);
  EXPECT_EQ(planner_.prepare(problem_).value, 1.0);
}

TEST_F(ProblemCheck, RefusesColonyParametersOutOfRangeByNumber) {
  const ColonyParameters sound = problem_.colony;
  ColonyParameters& colony = problem_.colony;
  const auto expect_refused = [&](ColonyParameterNumber number) {
    expect(RefusalCode::kColonyInvalid, -1, static_cast<int>(number));
    colony = sound;
  };
  colony.generations = 0;
  expect_refused(ColonyParameterNumber::kGenerations);
  colony.ants = 0;
  expect_refused(ColonyParameterNumber::kAnts);
  colony.beta = 13;
  expect_refused(ColonyParameterNumber::kBeta);
  colony.beta = -1;
  expect_refused(ColonyParameterNumber::kBeta);
  for (const double bad : {0.0, 1.5, kNan}) {
    colony.rho = bad;
    expect_refused(ColonyParameterNumber::kRho);
  }
  for (const double bad : {-0.1, 1.1, kNan}) {
    colony.iteration_best = bad;
    expect_refused(ColonyParameterNumber::kIterationBest);
    colony.ant.shortest_first = bad;
    expect_refused(ColonyParameterNumber::kShortestFirst);
    colony.ant.max_unseen_mass = bad;
    expect_refused(ColonyParameterNumber::kMaxUnseenMass);
  }
}

TEST_F(ProblemCheck, RefusesGaussiansThatAreNoneByNumber) {
  problem_.prior = std::span<const GaussianComponent>(gaussians_);
  ASSERT_FALSE(refusal());
  const GaussianComponent sound = gaussians_[1];
  for (const GaussianComponent& bad :
       {GaussianComponent{{kNan, 1.0}, 1.0, 1.0}, GaussianComponent{{1.0, kInfinite}, 1.0, 1.0},
        GaussianComponent{{1.0, 1.0}, 0.0, 1.0}, GaussianComponent{{1.0, 1.0}, -1.0, 1.0},
        GaussianComponent{{1.0, 1.0}, 1e-200, 1.0}, GaussianComponent{{1.0, 1.0}, kNan, 1.0},
        GaussianComponent{{1.0, 1.0}, 1.0, -1.0}, GaussianComponent{{1.0, 1.0}, 1.0, kNan},
        GaussianComponent{{1.0, 1.0}, 1.0, kInfinite}}) {
    gaussians_[1] = bad;
    expect(RefusalCode::kGaussianInvalid, -1, 1);
  }
  gaussians_[1] = sound;
}

TEST_F(ProblemCheck, RefusesAPriorWhoseMassIsNotFinite) {
  problem_.prior = std::span<const GaussianComponent>(gaussians_);
  gaussians_[1].weight = 1e308;
  expect(RefusalCode::kPriorNotFinite);
  EXPECT_EQ(planner_.prepare(problem_).value, kInfinite);
}

TEST(Normalise, RefusesMassesBelowZeroAndThatAreNoNumbers) {
  static Belief belief;
  static SightTable sight;
  static Cells cells;
  ASSERT_FALSE(cells.build(test::DrawnMap(1.0, 0.5, 0.5).view(), 0.5));
  std::array<double, 2> raw{};
  for (const double bad : {-1e-9, kNan, -kInfinite}) {
    raw = {1.0, bad};
    const Refusal refusal = normalise(cells, sight, 1, raw, belief);
    EXPECT_EQ(refusal.code, RefusalCode::kPriorNotFinite);
    EXPECT_TRUE(std::isnan(bad) ? std::isnan(refusal.value) : refusal.value == bad);
  }
  raw[1] = kInfinite;
  EXPECT_EQ(normalise(cells, sight, 1, raw, belief).code, RefusalCode::kPriorNotFinite);
}

TEST_F(ProblemCheck, RefusesImagesThatAreNotWhole) {
  const std::vector<std::uint16_t> values(32, 1);
  problem_.prior = GreyView{values, 8, 4, 2.0};
  ASSERT_FALSE(refusal());
  for (const GreyView& bad : {GreyView{values, 8, 5, 2.0}, GreyView{values, 0, 4, 2.0}, GreyView{values, -8, -4, 2.0},
                              GreyView{values, 8, 4, 0.0}, GreyView{values, 8, 4, kNan}}) {
    problem_.prior = bad;
    expect(RefusalCode::kImageInvalid);
  }
}

TEST_F(ProblemCheck, TakesAPriorImageOfTinyPixels) {
  const std::vector<std::uint16_t> values(4, 1);
  problem_.prior = GreyView{values, 2, 2, 1e-12};
  expect(RefusalCode::kPriorWithoutMass);
}

TEST_F(ProblemCheck, RefusesGivenSubPriorsThatDoNotFit) {
  const std::vector<std::uint16_t> values(32, 1);
  const GreyView whole{values, 8, 4, 2.0};
  std::vector<GreyView> images = {whole};
  problem_.sub_priors = SubPriorImages{images};
  expect(RefusalCode::kSubPriorsMismatch);
  images = {whole, {values, 8, 3, 2.0}};
  problem_.sub_priors = SubPriorImages{images};
  expect(RefusalCode::kImageInvalid, 1);
  std::vector<std::int8_t> dealt = {0, 1};
  problem_.sub_priors = DealtComponents{dealt};
  expect(RefusalCode::kSubPriorsMismatch);  // the prior is uniform
  problem_.prior = std::span<const GaussianComponent>(gaussians_);
  ASSERT_FALSE(refusal());
  dealt = {0, 2};
  expect(RefusalCode::kComponentDealtToNobody, -1, 1);
  dealt = {-1, 1};
  expect(RefusalCode::kComponentDealtToNobody, -1, 0);
  dealt = {0};
  problem_.sub_priors = DealtComponents{dealt};
  expect(RefusalCode::kSubPriorsMismatch);
}

TEST_F(ProblemCheck, RefusesGivenSubPriorsBesidePreferredAreasByAgent) {
  problem_.sub_priors = AlikeSubPriors{};
  ASSERT_FALSE(refusal());
  ASSERT_TRUE(problem_.agents[1].preferred.push_back(test::rectangle(1, 1, 3, 3)));
  expect(RefusalCode::kSubPriorsTwice, 1);
}

// What follows is sound: little to do is no fault.

TEST_F(ProblemCheck, AnAgentWalledInStaysAndTheOtherSearches) {
  map_.put(kWall, 12.0, 0.0, 12.5, 8.0);
  map_.put(kWall, 12.5, 3.0, 16.0, 3.5);
  map_.put(kWall, 14.0, 0.0, 14.5, 3.0);
  problem_.agents[1].body.start = {13.25, 1.5};  // in a closet of 1.5 x 3 m
  problem_.graph.clearance_m = 1.0;              // that leaves no other node in it
  const Plan& p = plan();
  EXPECT_EQ(planner_.graph().nodes_reached_by(1), 1);
  EXPECT_EQ(p.paths[1].length_m, 0.0);
  EXPECT_GT(p.paths[0].length_m, 5.0);
  EXPECT_TRUE(p.score.complete);
  EXPECT_GT(planner_.belief().unobservable_share, 0.05);  // the rest of the strip behind the wall
}

TEST_F(ProblemCheck, WithOneNodeReachedByAllThePlanIsToStay) {
  problem_.graph = {.spacing_m = 16.0, .clearance_m = 5.0};  // 5 m from the border: no node but the starts
  problem_.agents.resize(1);
  const Plan& p = plan();
  EXPECT_EQ(planner_.graph().nodes(), 1);
  ASSERT_EQ(p.paths[0].waypoints.size(), 1U);
  EXPECT_TRUE(p.score.complete);  // of what can be observed
  EXPECT_EQ(p.score.expected_time_s, 0.0);
  EXPECT_EQ(p.score.expected_time_continuous_s, 0.0);
  EXPECT_GT(planner_.belief().unobservable_share, 0.8);
  EXPECT_EQ(planner_.bounds(p.score.unseen_mass).bound_s(), 0.0);
}

TEST_F(ProblemCheck, APriorOnOneCellIsFoundAndTimesAreThoseOfThatCell) {
  std::vector<std::uint16_t> values(32 * 16, 0);
  values[8 * 32 + 28] = 1;
  problem_.prior = GreyView{values, 32, 16, 0.5};
  problem_.colony.generations = 60;
  const Plan& p = plan();
  EXPECT_EQ(planner_.belief().mass_cell_count, 1);
  EXPECT_TRUE(p.score.complete);
  EXPECT_NEAR(p.score.expected_time_continuous_s, p.score.horizon_s, 1e-12);
  const Bounds bounds = planner_.bounds(p.score.unseen_mass);
  EXPECT_LE(bounds.bound_strict_s(), p.score.expected_time_continuous_s);
  EXPECT_GT(bounds.bound_strict_s(), 0.8 * p.score.expected_time_continuous_s);
}

TEST_F(ProblemCheck, RestrictedAreasThatOverlapAndCutTheGraphLeaveTheFarPartToOthers) {
  for (SearchAgent& agent : problem_.agents) {
    ASSERT_TRUE(agent.body.restricted.push_back(test::rectangle(6, -1, 9, 5)));
    ASSERT_TRUE(agent.body.restricted.push_back(test::rectangle(7, 3, 10, 9)));
  }
  ASSERT_TRUE(plan().score.complete);
  EXPECT_GT(planner_.belief().unobservable_share, 0.3);
  for (Node n = 0; n < planner_.graph().nodes(); ++n) {
    EXPECT_TRUE(planner_.graph().position(n).x_m < 7.0 || planner_.graph().reached_by(n) == 0);
  }
  problem_.agents[1].body.start = {13.0, 1.0};  // one on each side
  ASSERT_TRUE(plan().score.complete);
  EXPECT_LT(planner_.belief().unobservable_share, 0.1);
}

}  // namespace
}  // namespace ivo::planner
