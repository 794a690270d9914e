#include "firmware/tools/bench/scenes.hpp"

#include <gtest/gtest.h>

#include "firmware/tools/bench/walkable.hpp"
#include "tests/support/drawn_map.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::firmware::bench {
namespace {

double sub_mass_below(const planner::Planner& planner, std::size_t agent, double y_m) {
  double sum = 0.0;
  for (const planner::Cell c : planner.belief().cells_with_mass()) {
    if (planner.cells().centre(c).y_m < y_m) {
      sum += planner.belief().sub_mass[agent][static_cast<std::size_t>(c)];
    }
  }
  return sum;
}

TEST(PaperScene, IsTheMapOfTheTableAtEitherSpacing) {
  Result<Scene> scene = paper_scene(PaperMap::kM1, PaperPrior::kUniform, 3.5);
  ASSERT_TRUE(scene.ok());
  planner::Planner& planner = test::shared_planner();
  ASSERT_FALSE(planner.prepare(scene.value().problem));
  EXPECT_EQ(planner.graph().nodes(), 144);
  EXPECT_EQ(planner.graph().position(1), (Point{39.25, 1.75}));
  EXPECT_FALSE(planner.belief().has_sub_priors);
  scene = paper_scene(PaperMap::kM1, PaperPrior::kUniform, 5.0);
  ASSERT_FALSE(planner.prepare(scene.value().problem));
  EXPECT_EQ(planner.graph().nodes(), 64);
  EXPECT_EQ(planner.graph().position(0), (Point{2.5, 2.5}));
  EXPECT_EQ(planner.graph().position(1), (Point{37.5, 2.5}));
}

TEST(PaperScene, GivesEachAgentTheGaussianNearItsStartOrTheOtherOne) {
  planner::Planner& planner = test::shared_planner();
  Result<Scene> scene = paper_scene(PaperMap::kM1, PaperPrior::kGaussiansSubPriors, 3.5);
  ASSERT_FALSE(planner.prepare(scene.value().problem));
  ASSERT_TRUE(planner.belief().has_sub_priors);
  EXPECT_NEAR(sub_mass_below(planner, 0, 40.0), 0.5, 1e-9);
  EXPECT_GT(sub_mass_below(planner, 0, 20.0), 0.48);
  EXPECT_LT(sub_mass_below(planner, 1, 20.0), 0.02);
  scene = paper_scene(PaperMap::kM1, PaperPrior::kGaussiansExchanged, 3.5);
  ASSERT_FALSE(planner.prepare(scene.value().problem));
  EXPECT_LT(sub_mass_below(planner, 0, 20.0), 0.02);
  EXPECT_GT(sub_mass_below(planner, 1, 20.0), 0.48);
}

TEST(PaperScene, HalvesTheUniformPriorBetweenTheAgents) {
  planner::Planner& planner = test::shared_planner();
  const Result<Scene> scene = paper_scene(PaperMap::kM1, PaperPrior::kUniformSubPriors, 3.5);
  ASSERT_FALSE(planner.prepare(scene.value().problem));
  const planner::Belief& belief = planner.belief();
  for (const planner::Cell c : belief.cells_with_mass()) {
    const auto i = static_cast<std::size_t>(c);
    ASSERT_NEAR(belief.sub_mass[0][i], belief.mass[i] / 2, 1e-15);
    ASSERT_NEAR(belief.sub_mass[1][i], belief.mass[i] / 2, 1e-15);
  }
}

TEST(OpenGround, KeepsTheSecondAgentFromTheBorderWhereTheLastSquareIsCut) {
  const Scene scene = open_ground(36.0, 20.0, 0.25, 3.5);  // the last square is 1 m wide
  EXPECT_FALSE(test::shared_planner().prepare(scene.problem));
}

TEST(Dubai, IsRefusedWhereThereIsNoData) {
  EXPECT_FALSE(dubai_scene("/nowhere", 5.0).ok());
  EXPECT_FALSE(sarenv_scene("/nowhere").ok());
}

TEST(Walkable, IsTheLargestPlaceAndNotTheNearest) {
  test::DrawnMap map(20, 10, 0.25);
  map.put(SemanticClass::kWall, 4, 0, 5, 10);
  const Walkable walkable(map.view(), 0.5);
  const Point p = walkable.nearest({2, 5});  // in the smaller place, left of the wall
  EXPECT_NEAR(p.x_m, 5.5, 0.26);
  EXPECT_GE(p.x_m, 5.5);
  EXPECT_EQ(walkable.nearest({10.125, 5.125}), (Point{10.125, 5.125}));
}

}  // namespace
}  // namespace ivo::firmware::bench
