#include "firmware/tools/planner_setup.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_planner.hpp"
#include "tests/unit/firmware/files/complaint.hpp"
#include "tests/unit/firmware/files/written_png.hpp"

namespace ivo::firmware {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const std::string kSource = IVO_SOURCE_DIR;
const std::string kMission =
    "format = 1\n"  // 1
    "map = '" +
    kSource +
    "/config/maps/m1.toml'\n"  // 2
    "prior = 'uniform'\n"      // 3
    "[planner]\n"              // 4
    "cell_m = 0.5\n"           // 5
    "[[agent]]\n"              // 6
    "name = 'IVO'\n"           // 7
    "kind = 'robot'\n"         // 8
    "robot = '" +
    kSource +
    "/config/robots/ivo.toml'\n"  // 9
    "start_m = [1.75, 1.75]\n"    // 10
    "speed_mps = 0.4\n"           // 11
    "sight_radius_m = 2.5\n"      // 12
    "[[agent]]\n"                 // 13
    "name = 'Ana'\n"              // 14
    "kind = 'person'\n"           // 15
    "start_m = [30, 2]\n"         // 16
    "speed_mps = 0.6\n"           // 17
    "sight_radius_m = 3\n";       // 18

std::string without(std::string message, const ScratchFolder& folder) {
  const std::size_t at = message.find(folder.path() + "/");
  return at == std::string::npos ? message : message.erase(at, folder.path().size() + 1);
}

std::string complaint_in(const ScratchFolder& folder, const std::string& text) {
  const Result<MissionInputs> inputs = read_inputs(folder.put("m.toml", text));
  return without(inputs.ok() ? message_of(prepare(test::shared_planner(), inputs.value())) : inputs.error().message,
                 folder);
}

std::string complaint_of(const std::string& text) { return complaint_in(ScratchFolder(), text); }

std::string with_prior(const std::string& prior) { return replaced(kMission, "prior = 'uniform'", "prior = " + prior); }

std::string two_gaussians(const std::string& first, const std::string& second) {
  return with_prior("{ gaussians = [ { mean_m = [9, 9], sigma_m = 3" + first + " }, { mean_m = [30, 30], sigma_m = 3" +
                    second + " } ] }");
}

TEST(PlannerSetup, GivesSubPriorsThatAreAlike) {
  EXPECT_EQ(complaint_of(with_prior("{ uniform = true, sub_priors = 'alike' }")), "fine");
  const planner::Belief& belief = test::shared_planner().belief();
  ASSERT_TRUE(belief.has_sub_priors);
  for (const planner::Cell c : belief.cells_with_mass()) {
    const auto i = static_cast<std::size_t>(c);
    ASSERT_NEAR(belief.sub_mass[0][i], belief.mass[i] / 2, 1e-15);
    ASSERT_NEAR(belief.sub_mass[1][i], belief.mass[i] / 2, 1e-15);
  }
}

TEST(PlannerSetup, DealsGaussiansToTheAgentsTheyName) {
  EXPECT_EQ(complaint_of(two_gaussians(", agent = 'Ana'", ", agent = 'IVO'")), "fine");
  const planner::Planner& planner = test::shared_planner();
  const auto near_first = static_cast<std::size_t>(planner.cells().at(18, 18));
  ASSERT_TRUE(planner.belief().has_sub_priors);
  EXPECT_GT(planner.belief().sub_mass[1][near_first], 1e6 * planner.belief().sub_mass[0][near_first]);
}

TEST(PlannerSetup, RefusesGaussiansDealtToSomeOrToNobody) {
  EXPECT_EQ(complaint_of(two_gaussians(", agent = 'Ana'", "")),
            "m.toml:3: prior.gaussians[1].agent: missing; expected every Gaussian to name an agent, or none");
  EXPECT_EQ(complaint_of(two_gaussians(", agent = 'Ana'", ", agent = 'Bob'")),
            "m.toml:3: prior.gaussians[1].agent: \"Bob\" is no agent of this mission; expected the name of one");
}

TEST(PlannerSetup, RefusesSubPriorsGivenTwice) {
  std::string both = two_gaussians("", ", agent = 'IVO'");
  EXPECT_EQ(
      complaint_of(replaced(both, "prior = {", "prior = { sub_priors = 'alike',")),
      "m.toml:3: prior.gaussians[1].agent: gives sub-priors a second time beside prior.sub_priors; expected one of "
      "the two");
  EXPECT_EQ(
      complaint_of(with_prior("{ uniform = true, sub_priors = 'alike' }") +
                   "sub_prior = { image = 'x.png', resolution_m = 1 }\n"),
      "m.toml:19: agent[1].sub_prior: gives sub-priors a second time beside the prior's; expected one of the two");
  EXPECT_EQ(complaint_of(with_prior("{ uniform = true, sub_priors = 'alike' }") +
                         "preferred = [{ rectangle_m = [1, 1, 5, 5] }]\n"),
            "m.toml:19: agent[1].preferred: preferred areas beside sub-priors that are given; expected one of the two");
}

TEST(PlannerSetup, ReadsASubPriorImageOfEachAgent) {
  const ScratchFolder folder;
  (void)folder.put("left.png", written_png(2, 1, {.type = PNG_COLOR_TYPE_GRAY}, {200, 0}));
  (void)folder.put("right.png", written_png(2, 1, {.type = PNG_COLOR_TYPE_GRAY}, {0, 7}));
  const std::string of_robot = replaced(kMission, "speed_mps = 0.4\n",
                                        "speed_mps = 0.4\nsub_prior = { image = 'left.png', resolution_m = 20 }\n");
  EXPECT_EQ(complaint_in(folder, of_robot + "sub_prior = { image = 'right.png', resolution_m = 20 }\n"), "fine");
  const planner::Planner& planner = test::shared_planner();
  ASSERT_TRUE(planner.belief().has_sub_priors);
  const auto left = static_cast<std::size_t>(planner.cells().at(10, 10));
  const auto right = static_cast<std::size_t>(planner.cells().at(70, 10));
  EXPECT_NEAR(planner.belief().sub_mass[0][left], 0.5 / 1600, 1e-12);  // 1600 cells under the pixel
  EXPECT_EQ(planner.belief().sub_mass[0][right], 0.0);
  EXPECT_EQ(planner.belief().sub_mass[1][left], 0.0);
  EXPECT_NEAR(planner.belief().sub_mass[1][right], 0.5 / 1600, 1e-12);
}

TEST(PlannerSetup, RefusesASubPriorForOneAgentAlone) {
  EXPECT_EQ(complaint_of(kMission + "sub_prior = { image = 'x.png', resolution_m = 1 }\n"),
            "m.toml:6: agent[0].sub_prior: missing; expected every agent to have one, or none");
}

// Problems that no file can state, in the words for them.
class InvalidInputs : public testing::Test {
 protected:
  InvalidInputs() : inputs_(read_inputs(folder_.put("m.toml", kMission))) {}

  Mission& mission() { return inputs_.value().file.mission; }
  std::string complaint() { return without(message_of(prepare(test::shared_planner(), inputs_.value())), folder_); }

  ScratchFolder folder_;
  Result<MissionInputs> inputs_;
};

TEST_F(InvalidInputs, AreRefusedForSizesThatAreNone) {
  mission().planner.cell_m = kNan;
  EXPECT_EQ(complaint(), "m.toml:5: planner.cell_m: nan is no size of a cell; expected metres above 0");
  mission().planner.cell_m = 0.5;
  mission().planner.spacing_m = 0.0;
  EXPECT_EQ(complaint(),
            "m.toml:4: planner.spacing_m: 0 is no side of a square; expected metres above 0, at most 1000000000");
  mission().planner.spacing_m = 3.5;
  mission().planner.clearance_m = -1.0;
  EXPECT_EQ(complaint(), "m.toml:4: planner.clearance_m: -1 is no distance; expected metres, 0 or more");
}

TEST_F(InvalidInputs, AreRefusedForAgentsThatCannotSearch) {
  AgentSpec& ana = mission().agents[1];
  ana.speed_mps = 0.0;
  EXPECT_EQ(complaint(),
            "m.toml:17: agent[1].speed_mps: 0 is no speed to search at; expected at least 0.0001 (metres a second)");
  ana.speed_mps = 0.6;
  ana.sight_radius_m = 0.0;
  EXPECT_EQ(complaint(),
            "m.toml:18: agent[1].sight_radius_m: 0 is no radius to see with; expected above 0, at most "
            "50000000 (metres)");
  ana.sight_radius_m = 3.0;
  ana.footprint_radius_m = -0.5;
  EXPECT_EQ(complaint(), "m.toml:13: agent[1].footprint_radius_m: -0.5 is no radius; expected metres, 0 or more");
  ana.footprint_radius_m = 0.3;
  ana.restricted = {{{20, 20}, {21, 21}}};
  EXPECT_EQ(complaint(), "m.toml:13: agent[1].restricted[0]: is no polygon; expected at least 3 vertices, in metres");
  mission().agents.clear();
  EXPECT_EQ(complaint(), "m.toml:6: agent: there is no agent; expected at least one");
}

TEST_F(InvalidInputs, AreRefusedForColonyParametersOutOfRange) {
  mission().planner.rho = 0.0;
  EXPECT_EQ(complaint(), "m.toml:4: planner.rho: 0 is out of range; expected above 0, at most 1");
  mission().planner.rho = 0.02;
  mission().planner.max_unseen_mass = 1.5;
  EXPECT_EQ(complaint(), "m.toml:4: planner.max_unseen_mass: 1.5 is out of range; expected 0 to 1");
  mission().planner.max_unseen_mass = 0.014;
  mission().planner.ants = 0;
  EXPECT_EQ(complaint(), "m.toml:4: planner.ants: 0 is out of range; expected at least 1");
}

TEST_F(InvalidInputs, AreRefusedForPriorsThatAreNone) {
  inputs_.value().gaussians = {{{9, 9}, 1, 1}, {{9, 9}, 0, 1}};
  EXPECT_EQ(complaint(),
            "m.toml:3: prior.gaussians[1]: is no Gaussian; expected a finite mean, sigma_m above 0 and a "
            "weight, 0 or more");
  inputs_.value().gaussians = {{{9, 9}, 4, 1e308}};
  EXPECT_EQ(complaint(), "m.toml:3: prior: holds a mass of inf; expected finite numbers, 0 or more");
  inputs_.value().gaussians = {{{9, 9}, 1, 1}};
  inputs_.value().sub_priors.agent_of_component = {0, 1};
  EXPECT_EQ(complaint(), "m.toml:3: prior: sub-priors for 2; expected for 1");
  inputs_.value().sub_priors.agent_of_component = {2};
  EXPECT_EQ(complaint(), "m.toml:3: prior.gaussians[0].agent: agent 2 of 2 is none; expected an agent of this mission");
}

TEST_F(InvalidInputs, AreRefusedForAMapWhosePixelsAreMissing) {
  inputs_.value().map.pixels.pop_back();
  const std::string all = std::to_string(inputs_.value().map.width_px * inputs_.value().map.height_px);
  const std::string less = std::to_string(inputs_.value().map.pixels.size());
  EXPECT_EQ(complaint(), "m.toml:2: map: has " + less + " pixels; expected " + all);
}

}  // namespace
}  // namespace ivo::firmware
