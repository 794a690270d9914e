#include "planner/prior/sub_priors.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/support/agreement.hpp"
#include "tests/support/m1.hpp"
#include "tests/support/masses.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using enum SemanticClass;

class SubPriorsTest : public testing::Test {
 protected:
  SubPriorsTest() {
    problem_.cell_m = 0.5;
    problem_.graph.spacing_m = 2.0;
    problem_.agents.resize(2);
    problem_.agents[0].body.start = {1.0, 1.0};
    problem_.agents[1].body.start = {15.0, 1.0};
  }

  void prepare() {
    problem_.map = map_.view();
    ASSERT_EQ(planner_.prepare(problem_).code, RefusalCode::kNone);
    ASSERT_TRUE(planner_.belief().has_sub_priors);
    for (int m = 0; m < 2; ++m) {
      const auto sub = test::as_doubles(planner_.belief().sub_mass[index(m)], planner_.belief().cells);
      EXPECT_NEAR(std::accumulate(sub.begin(), sub.end(), 0.0), 0.5, test::sum_agreement(planner_.belief().cells));
    }
  }
  [[nodiscard]] double share(int agent, double x_m, double y_m) const {
    const Cell c = planner_.cells().at(static_cast<int>(x_m / 0.5), static_cast<int>(y_m / 0.5));
    return to_double(planner_.belief().sub_mass[index(agent)][index(c)]);
  }
  [[nodiscard]] double prior(double x_m, double y_m) const {
    return to_double(
        planner_.belief().mass[index(planner_.cells().at(static_cast<int>(x_m / 0.5), static_cast<int>(y_m / 0.5)))]);
  }

  test::DrawnMap map_{16.0, 8.0, 0.5};
  SearchProblem problem_;
  std::vector<GaussianComponent> gaussians_ = {{{3.0, 4.0}, 1.0, 1.0}, {{13.0, 4.0}, 1.0, 3.0}};
  Planner& planner_ = test::shared_planner();
};

TEST_F(SubPriorsTest, AlikeAreThePriorsPart) {
  problem_.prior = std::span<const GaussianComponent>(gaussians_);
  problem_.sub_priors = AlikeSubPriors{};
  prepare();
  EXPECT_EQ(planner_.left_without_sub_prior(), 0);
  for (const double x_m : {1.0, 3.0, 8.0, 13.0}) {
    EXPECT_NEAR(share(0, x_m, 4.0), prior(x_m, 4.0) / 2, test::kMassAgreement);
    EXPECT_NEAR(share(1, x_m, 4.0), prior(x_m, 4.0) / 2, test::kMassAgreement);
  }
}

TEST_F(SubPriorsTest, DealtGiveEachAgentItsComponentsWhateverTheirWeight) {
  problem_.prior = std::span<const GaussianComponent>(gaussians_);
  const std::vector<std::int8_t> crossed = {1, 0};
  problem_.sub_priors = DealtComponents{crossed};
  prepare();
  EXPECT_GT(share(1, 3.0, 4.0), 0.015);
  EXPECT_NEAR(share(1, 3.0, 4.0), share(0, 13.0, 4.0), 1e-6);  // alike in shape, each of half the mass
  EXPECT_LT(share(0, 3.0, 4.0), 1e-9);
  EXPECT_LT(share(1, 13.0, 4.0), 1e-9);
}

TEST_F(SubPriorsTest, OfAnAgentThatIsDealtNothingAreThePriorAndThatIsSaid) {
  problem_.prior = std::span<const GaussianComponent>(gaussians_);
  const std::vector<std::int8_t> all_to_one = {0, 0};
  problem_.sub_priors = DealtComponents{all_to_one};
  prepare();
  EXPECT_EQ(planner_.left_without_sub_prior(), agent_bit(1));
  EXPECT_NEAR(share(1, 13.0, 4.0), prior(13.0, 4.0) / 2, test::kMassAgreement);
}

TEST_F(SubPriorsTest, FromImagesCountOnlyWhereThePriorHasMass) {
  std::vector<std::uint16_t> left(4, 0);
  left[0] = 5;
  std::vector<std::uint16_t> right(4, 0);
  right[2] = 1;
  right[3] = 3;
  const std::vector<GreyView> images = {{left, 4, 1, 4.0}, {right, 4, 1, 4.0}};
  problem_.sub_priors = SubPriorImages{images};
  map_.put(kWater, 12.0, 4.0, 16.0, 8.0);  // 64 of the 128 cells under the last pixel that reaches up to 4 m
  prepare();
  EXPECT_NEAR(share(0, 1.0, 1.0), 0.5 / 64, test::kMassAgreement);  // the images cover the lower 4 m
  EXPECT_EQ(share(0, 1.0, 5.0), 0.0);
  EXPECT_EQ(share(0, 5.0, 1.0), 0.0);
  EXPECT_NEAR(share(1, 9.0, 1.0), 0.5 * 1 / (4 * 64), test::kMassAgreement);
  EXPECT_NEAR(share(1, 13.0, 1.0), 0.5 * 3 / (4 * 64), test::kMassAgreement);
  EXPECT_EQ(share(1, 13.0, 5.0), 0.0);
}

TEST_F(SubPriorsTest, CountOnlyWhatTheAgentCanObserve) {
  map_.put(kWall, 7.5, 0.0, 8.0, 8.0);
  for (const bool alike : {true, false}) {
    std::vector<std::uint16_t> everywhere(1, 9);
    const std::vector<GreyView> images(2, GreyView{everywhere, 1, 1, 100.0});
    problem_.sub_priors = alike ? SubPriorChoice(AlikeSubPriors{}) : SubPriorChoice(SubPriorImages{images});
    prepare();
    EXPECT_EQ(share(0, 12.0, 4.0), 0.0);
    EXPECT_EQ(share(1, 3.0, 4.0), 0.0);
    EXPECT_GT(share(0, 3.0, 4.0), prior(3.0, 4.0) * 0.9);
  }
}

TEST_F(SubPriorsTest, AreForgottenWithTheNextMission) {
  problem_.sub_priors = AlikeSubPriors{};
  prepare();
  problem_.sub_priors = {};
  ASSERT_EQ(planner_.prepare(problem_).code, RefusalCode::kNone);
  EXPECT_FALSE(planner_.belief().has_sub_priors);
}

TEST(NearestAgent, IsByTheStartAndTheLowestOnATie) {
  const std::vector<Point> starts = {{0.0, 0.0}, {10.0, 0.0}};
  EXPECT_EQ(nearest_agent({{2.0, 5.0}, 1.0, 1.0}, starts), 0);
  EXPECT_EQ(nearest_agent({{8.0, 5.0}, 1.0, 1.0}, starts), 1);
  EXPECT_EQ(nearest_agent({{5.0, 5.0}, 1.0, 1.0}, starts), 0);
}

// Table I, G/S: exchanged, each agent is sent past the other's Gaussian to its own.
TEST(SubPriors, DealtTheWrongWayMakePlansMuchSlower) {
  const std::vector<GaussianComponent> gaussians = {{{10.0, 20.0}, 3.0, 1.0}, {{30.0, 20.0}, 3.0, 1.0}};
  double expected_s[2] = {};
  for (const int exchanged : {0, 1}) {
    test::M1 m1(60);
    m1.problem().cell_m = 0.5;
    m1.problem().prior = std::span<const GaussianComponent>(gaussians);
    std::vector<std::int8_t> agents;
    for (const GaussianComponent& g : gaussians) {
      const std::vector<Point> starts = {m1.problem().agents[0].body.start, m1.problem().agents[1].body.start};
      agents.push_back(static_cast<std::int8_t>(nearest_agent(g, starts) ^ exchanged));
    }
    m1.problem().sub_priors = DealtComponents{agents};
    ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
    expected_s[exchanged] = test::plan_of(test::shared_planner()).score.expected_time_s;
  }
  EXPECT_GT(expected_s[1], 1.2 * expected_s[0]);
}

}  // namespace
}  // namespace ivo::planner
