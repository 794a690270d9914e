#include "planner/prior/preferences.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>
#include <random>
#include <vector>

#include "tests/support/agreement.hpp"
#include "tests/support/masses.hpp"
#include "tests/support/random_search.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

using enum SemanticClass;

// An open place of 16 x 8 m in 512 cells of half a metre; everybody sees everything.
class PreferencesTest : public testing::Test {
 protected:
  explicit PreferencesTest() { agents(2); }

  void agents(std::size_t count) {
    problem_.map = map_.view();
    problem_.cell_m = 0.5;
    problem_.graph.spacing_m = 4.0;
    problem_.agents.clear();
    problem_.agents.resize(count);
    for (std::size_t m = 0; m < count; ++m) {
      problem_.agents[m].body.start = {1.0 + 2.0 * static_cast<double>(m), 1.0};
    }
  }

  void prefers(std::size_t agent, const Area& area) { ASSERT_TRUE(problem_.agents[agent].preferred.push_back(area)); }

  void prepare() { ASSERT_EQ(planner_.prepare(problem_).code, RefusalCode::kNone); }

  [[nodiscard]] double share(int agent, double x_m, double y_m) const {
    const Cells& cells = planner_.cells();
    const Cell c = cells.at(static_cast<int>(x_m / 0.5), static_cast<int>(y_m / 0.5));
    return to_double(planner_.belief().sub_mass[static_cast<std::size_t>(agent)][static_cast<std::size_t>(c)]);
  }

  void expect_each_sums_to_its_part() const {
    const Belief& belief = planner_.belief();
    for (int m = 0; m < belief.agents; ++m) {
      const auto sub = test::as_doubles(belief.sub_mass[static_cast<std::size_t>(m)], belief.cells);
      EXPECT_NEAR(std::accumulate(sub.begin(), sub.end(), 0.0), 1.0 / belief.agents, test::sum_agreement(belief.cells));
    }
  }

  test::DrawnMap map_{16.0, 8.0, 0.5};
  SearchProblem problem_;
  Planner& planner_ = test::shared_planner();
};

TEST_F(PreferencesTest, OfNobodyMakeNoSubPriors) {
  prepare();
  EXPECT_FALSE(planner_.belief().has_sub_priors);
  EXPECT_EQ(planner_.left_without_sub_prior(), 0);
}

TEST_F(PreferencesTest, OfOneLeaveTheRestToTheOther) {
  prefers(0, test::rectangle(0, 0, 4, 8));  // 128 cells of 512
  prepare();
  EXPECT_TRUE(planner_.belief().has_sub_priors);
  EXPECT_NEAR(share(0, 1, 1), 0.5 / 128, test::kMassAgreement);
  EXPECT_EQ(share(1, 1, 1), 0.0);
  EXPECT_EQ(share(0, 9, 1), 0.0);
  EXPECT_NEAR(share(1, 9, 1), 0.5 / 384, test::kMassAgreement);
  expect_each_sums_to_its_part();
}

TEST_F(PreferencesTest, OfAllShareTheRestEqually) {
  prefers(0, test::rectangle(0, 0, 4, 8));    // 128 cells
  prefers(1, test::rectangle(12, 0, 16, 4));  // 64 cells; 320 are left
  prepare();
  EXPECT_NEAR(share(0, 1, 1), 0.5 / (128 + 160), test::kMassAgreement);
  EXPECT_NEAR(share(0, 8, 1), 0.25 / (128 + 160), test::kMassAgreement);
  EXPECT_NEAR(share(1, 13, 1), 0.5 / (64 + 160), test::kMassAgreement);
  EXPECT_NEAR(share(1, 8, 1), 0.25 / (64 + 160), test::kMassAgreement);
  EXPECT_EQ(share(0, 13, 1), 0.0);
  EXPECT_EQ(share(1, 1, 1), 0.0);
  expect_each_sums_to_its_part();
}

TEST_F(PreferencesTest, ThatOverlapShareTheOverlapEqually) {
  agents(3);
  prefers(0, test::rectangle(0, 0, 8, 8));   // 256 cells
  prefers(1, test::rectangle(4, 0, 12, 8));  // 256 cells, 128 of them the first one's too
  prepare();
  EXPECT_NEAR(share(0, 1, 1), 1.0 / 3 / (128 + 64), test::kMassAgreement);
  EXPECT_NEAR(share(0, 5, 1), 0.5 / 3 / (128 + 64), test::kMassAgreement);
  EXPECT_NEAR(share(1, 5, 1), 0.5 / 3 / (128 + 64), test::kMassAgreement);
  EXPECT_EQ(share(2, 5, 1), 0.0);
  EXPECT_NEAR(share(2, 13, 1), 1.0 / 3 / 128, test::kMassAgreement);  // the only one without a preference
  expect_each_sums_to_its_part();
}

TEST_F(PreferencesTest, OfOneAgentCountACellOnceThoughItsAreasOverlap) {
  prefers(0, test::rectangle(0, 0, 4, 8));
  prefers(0, test::rectangle(2, 0, 6, 8));
  prepare();
  EXPECT_NEAR(share(0, 1, 1), 0.5 / 192, test::kMassAgreement);
  EXPECT_NEAR(share(0, 3, 1), 0.5 / 192, test::kMassAgreement);
  expect_each_sums_to_its_part();
}

TEST_F(PreferencesTest, ThatTakeEverythingLeaveTheOtherThePriorItselfAndSaySo) {
  prefers(0, test::rectangle(-1, -1, 17, 9));
  prepare();
  EXPECT_EQ(planner_.left_without_sub_prior(), agent_bit(1));
  EXPECT_NEAR(share(1, 1, 1), 0.5 / 512, test::kMassAgreement);
  EXPECT_NEAR(share(0, 1, 1), 0.5 / 512, test::kMassAgreement);
  expect_each_sums_to_its_part();
}

TEST_F(PreferencesTest, OfAnEarlierMissionLeaveNothingBehind) {
  prefers(0, test::rectangle(0, 0, 4, 8));
  prepare();
  map_.put(kWater, 9.0, 0.0, 16.0, 8.0);
  prepare();
  EXPECT_EQ(share(1, 13, 1), 0.0);
  expect_each_sums_to_its_part();
}

TEST_F(PreferencesTest, CountOnlyWhatTheAgentCanObserve) {
  map_.put(kWall, 7.5, 0.0, 8.0, 8.0);
  problem_.agents[1].body.start = {15.0, 1.0};
  prefers(0, test::rectangle(4, 0, 12, 8));  // reaches behind the wall
  prepare();
  EXPECT_GT(share(0, 5, 1), 0.0);
  EXPECT_EQ(share(0, 9, 1), 0.0);
  EXPECT_EQ(share(1, 9, 1), 0.0);  // preferred by the other, who cannot see it: nobody's
  EXPECT_GT(share(1, 13, 1), 0.0);
  expect_each_sums_to_its_part();
}

TEST_F(PreferencesTest, AreRefusedByAgentAndAreaWhereAnAreaCoversNoMass) {
  map_.put(kWater, 8.0, 0.0, 12.0, 4.0);
  prefers(0, test::rectangle(0, 0, 4, 8));
  prefers(1, test::rectangle(0, 0, 4, 8));
  prefers(1, test::rectangle(8.5, 0.5, 11.5, 3.5));
  const Refusal refusal = planner_.prepare(problem_);
  EXPECT_EQ(refusal.code, RefusalCode::kAreaWithoutMass);
  EXPECT_EQ(refusal.agent, 1);
  EXPECT_EQ(refusal.area, 1);
}

TEST_F(PreferencesTest, AreRefusedWhereOnlyTheOtherAgentCanSee) {
  map_.put(kWall, 7.5, 0.0, 8.0, 8.0);
  problem_.agents[1].body.start = {15.0, 1.0};
  prefers(1, test::rectangle(0, 0, 4, 8));
  const Refusal refusal = planner_.prepare(problem_);
  EXPECT_EQ(refusal.code, RefusalCode::kAreaWithoutMass);
  EXPECT_EQ(refusal.agent, 1);
  EXPECT_EQ(refusal.area, 0);
}

// The rules of the model, cell by cell and without a thought of speed.
std::vector<std::vector<double>> slow_sub_priors(const Planner& planner, const SearchProblem& problem) {
  const Belief& belief = planner.belief();
  const std::size_t agents = problem.agents.size();
  std::vector<std::vector<double>> sub(agents, std::vector<double>(static_cast<std::size_t>(belief.cells), 0.0));
  std::vector<std::size_t> silent;
  for (std::size_t m = 0; m < agents; ++m) {
    if (problem.agents[m].preferred.empty()) {
      silent.push_back(m);
    }
  }
  for (Cell c = 0; c < belief.cells; ++c) {
    std::vector<std::size_t> takers;
    for (std::size_t m = 0; m < agents; ++m) {
      if (contains(problem.agents[m].preferred, planner.cells().centre(c))) {
        takers.push_back(m);
      }
    }
    if (takers.empty()) {
      takers = silent;
    }
    if (takers.empty()) {
      takers.resize(agents);
      std::iota(takers.begin(), takers.end(), std::size_t{0});
    }
    for (const std::size_t m : takers) {
      const bool observes = in(planner.sight().observable_by(c), static_cast<int>(m));
      const double p = to_double(belief.mass[static_cast<std::size_t>(c)]);
      sub[m][static_cast<std::size_t>(c)] = observes ? p / static_cast<double>(takers.size()) : 0.0;
    }
  }
  for (std::vector<double>& s : sub) {
    double sum = std::accumulate(s.begin(), s.end(), 0.0);
    if (sum == 0.0) {
      s = test::as_doubles(belief.mass, belief.cells);
      sum = 1.0;
    }
    for (double& p : s) {
      p /= sum * static_cast<double>(agents);
    }
  }
  return sub;
}

TEST(Preferences, FollowTheRulesOnRandomSearches) {
  std::mt19937_64 random(99);
  Planner& planner = test::shared_planner();
  int checked = 0;
  for (int draw = 0; checked < 60; ++draw) {
    ASSERT_LT(draw, 1000);
    test::RandomSearch search(random);
    if (planner.prepare(search.problem()) || !planner.belief().has_sub_priors) {
      continue;
    }
    ++checked;
    const std::vector<std::vector<double>> expected = slow_sub_priors(planner, search.problem());
    for (std::size_t m = 0; m < expected.size(); ++m) {
      for (std::size_t c = 0; c < expected[m].size(); ++c) {
        ASSERT_NEAR(to_double(planner.belief().sub_mass[m][c]), expected[m][c], test::kMassAgreement)
            << "draw " << draw << ", agent " << m;
      }
    }
  }
}

}  // namespace
}  // namespace ivo::planner
