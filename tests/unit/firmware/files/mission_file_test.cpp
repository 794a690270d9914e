#include "firmware/files/mission_file.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "config/limits.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"

namespace ivo::firmware {
namespace {

const std::string kMission =
    "format = 1\n"                                 // 1
    "map = '../maps/yard.toml'\n"                  // 2
    "[planner]\n"                                  // 3
    "cell_m = 0.5\n"                               // 4
    "[[agent]]\n"                                  // 5
    "name = 'IVO'\n"                               // 6
    "kind = 'robot'\n"                             // 7
    "robot = '../robots/r.toml'\n"                 // 8
    "start_m = [1, 2]\n"                           // 9
    "heading_deg = 180\n"                          // 10
    "speed_mps = 0.4\n"                            // 11
    "sight_radius_m = 2\n"                         // 12
    "[[agent]]\n"                                  // 13
    "name = 'Ana'\n"                               // 14
    "kind = 'person'\n"                            // 15
    "motion = 'reported'\n"                        // 16
    "start_m = [3, 4]\n"                           // 17
    "speed_mps = 0.6\n"                            // 18
    "sight_radius_m = 3\n"                         // 19
    "preferred = [\n"                              // 20
    "{ rectangle_m = [1, 2, 3, 5] },\n"            // 21
    "{ polygon_m = [[0, 0], [4, 0], [2, 3]] },\n"  // 22
    "]\n";                                         // 23

Result<MissionFile> mission_of(const std::string& text) {
  const ScratchFolder folder;
  return read_mission(folder.put("m.toml", text));
}

std::string complaint_of(const std::string& text) {
  const ScratchFolder folder;
  return replaced(message_of(read_mission(folder.put("m.toml", text))), folder.path() + "/", "");
}

std::string complaint_about_mission(std::string_view from, std::string_view to) {
  return complaint_of(replaced(kMission, from, to));
}

std::string complaint_about_prior(const std::string& prior) {
  return complaint_about_mission("[planner]", "prior = " + prior + "\n[planner]");
}

std::string complaint_about_polygon(const std::string& vertices) {
  return complaint_about_mission("[[0, 0], [4, 0], [2, 3]]", vertices);
}

TEST(MissionFile, ReadsEveryFieldAndTheDefaults) {
  const ScratchFolder folder;
  const auto file = read_mission(folder.put("m.toml", kMission));
  ASSERT_TRUE(file.ok()) << file.error().message;
  const Mission& m = file.value().mission;
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.map_path, testing::TempDir() + "maps/yard.toml");
  EXPECT_EQ(m.seed, 1U);
  EXPECT_TRUE(std::holds_alternative<ObjectDrawn>(m.object));
  EXPECT_EQ(m.find, FindRule::kSight);
  EXPECT_TRUE(std::holds_alternative<UniformPrior>(m.prior));
  EXPECT_EQ(m.planner.cell_m, 0.5);
  EXPECT_EQ(m.planner.spacing_m, PlannerParameters{}.spacing_m);
  EXPECT_FALSE(m.planner.rho.has_value());
  EXPECT_EQ(m.planner.profile, SearchProfile::kFast);
  EXPECT_EQ(m.planner.heuristic, SearchHeuristic::kTsp);
  ASSERT_EQ(m.agents.size(), 2U);
  EXPECT_EQ(m.agents[0].name, "IVO");
  EXPECT_EQ(m.agents[0].kind, AgentKind::kRobot);
  EXPECT_EQ(m.agents[0].robot_path, testing::TempDir() + "robots/r.toml");
  EXPECT_EQ(m.agents[0].start, (Point{1, 2}));
  EXPECT_DOUBLE_EQ(m.agents[0].heading_rad, std::numbers::pi);
  EXPECT_EQ(m.agents[0].speed_mps, 0.4);
  EXPECT_EQ(m.agents[0].sight_radius_m, 2);
  EXPECT_EQ(m.agents[1].kind, AgentKind::kPerson);
  EXPECT_EQ(m.agents[1].motion, PersonMotion::kReported);
  EXPECT_EQ(m.agents[1].footprint_radius_m, 0.30);
  ASSERT_EQ(m.agents[1].preferred.size(), 2U);
  EXPECT_EQ(m.agents[1].preferred[0], (Polygon{{1, 2}, {3, 2}, {3, 5}, {1, 5}}));
  EXPECT_EQ(m.agents[1].preferred[1], (Polygon{{0, 0}, {4, 0}, {2, 3}}));
  EXPECT_TRUE(m.agents[1].restricted.empty());
}

TEST(MissionFile, ReadsEveryKindOfObjectAndPrior) {
  EXPECT_TRUE(std::holds_alternative<ObjectUnknown>(
      mission_of(replaced(kMission, "[planner]", "object = 'unknown'\n[planner]")).value().mission.object));
  EXPECT_EQ(std::get<Point>(
                mission_of(replaced(kMission, "[planner]", "object = [5, 6.5]\n[planner]")).value().mission.object),
            (Point{5, 6.5}));
  const auto gaussians = mission_of(replaced(
      kMission, "[planner]", "prior = { gaussians = [ { mean_m = [1, 2], sigma_m = 3, weight = 4 } ] }\n[planner]"));
  ASSERT_TRUE(gaussians.ok()) << gaussians.error().message;
  const Gaussian g = std::get<GaussianMixturePrior>(gaussians.value().mission.prior).components.at(0);
  EXPECT_EQ(g.mean, (Point{1, 2}));
  EXPECT_EQ(g.sigma_m, 3);
  EXPECT_EQ(g.weight, 4);
  const auto image =
      mission_of(replaced(kMission, "[planner]", "prior = { image = '/data/x.png', resolution_m = 0.25 }\n[planner]"));
  ASSERT_TRUE(image.ok()) << image.error().message;
  EXPECT_EQ(std::get<ImagePrior>(image.value().mission.prior).image_path, "/data/x.png");
  EXPECT_EQ(std::get<ImagePrior>(image.value().mission.prior).resolution_m, 0.25);
}

TEST(MissionFile, ReadsSubPriorsOfEveryKind) {
  EXPECT_FALSE(mission_of(kMission).value().mission.alike_sub_priors);
  const auto alike =
      mission_of(replaced(kMission, "[planner]", "prior = { uniform = true, sub_priors = 'alike' }\n[planner]"));
  ASSERT_TRUE(alike.ok()) << alike.error().message;
  EXPECT_TRUE(alike.value().mission.alike_sub_priors);
  EXPECT_TRUE(std::holds_alternative<UniformPrior>(alike.value().mission.prior));
  const auto dealt = mission_of(replaced(
      kMission, "[planner]", "prior = { gaussians = [ { mean_m = [1, 2], sigma_m = 3, agent = 'Ana' } ] }\n[planner]"));
  ASSERT_TRUE(dealt.ok()) << dealt.error().message;
  EXPECT_EQ(std::get<GaussianMixturePrior>(dealt.value().mission.prior).components.at(0).agent, "Ana");
  const auto image =
      mission_of(replaced(kMission, "heading_deg = 180", "sub_prior = { image = '/data/x.png', resolution_m = 0.25 }"));
  ASSERT_TRUE(image.ok()) << image.error().message;
  ASSERT_TRUE(image.value().mission.agents[0].sub_prior.has_value());
  EXPECT_EQ(image.value().mission.agents[0].sub_prior->image_path, "/data/x.png");
  EXPECT_EQ(image.value().mission.agents[0].sub_prior->resolution_m, 0.25);
  EXPECT_FALSE(image.value().mission.agents[1].sub_prior.has_value());
}

TEST(MissionFile, RefusesSubPriorsThatAreNone) {
  EXPECT_EQ(complaint_about_prior("{ uniform = true, sub_priors = 'equal' }"),
            "m.toml:3: prior.sub_priors: \"equal\" is unknown; expected \"alike\"");
  EXPECT_EQ(complaint_about_prior("{ uniform = false }"),
            "m.toml:3: prior.uniform: is no prior; expected true, or gaussians or image in its place");
  EXPECT_EQ(complaint_about_prior("{ uniform = true, image = 'x.png' }"),
            "m.toml:3: prior.image: a second prior beside uniform; expected one of the two");
  EXPECT_EQ(complaint_about_prior("{ uniform = true, gaussians = [ { mean_m = [1, 1], sigma_m = 1 } ] }"),
            "m.toml:3: prior.uniform: a second prior beside gaussians; expected one of the two");
  EXPECT_EQ(complaint_about_mission("heading_deg = 180", "sub_prior = { image = 'x.png' }"),
            "m.toml:10: agent[0].sub_prior.resolution_m: missing; it must be given, in metres");
  EXPECT_EQ(complaint_about_mission("heading_deg = 180", "sub_prior = 'x.png'"),
            "m.toml:10: agent[0].sub_prior: is no sub-prior; expected { image = \"...\", resolution_m = ... }");
}

TEST(MissionFile, ReadsEveryPlannerParameter) {
  const auto file = mission_of(replaced(kMission, "cell_m = 0.5",
                                        "profile = 'paper'\nheuristic = 'mts'\ncell_m = 0.1\nspacing_m = "
                                        "1.5\nclearance_m = 0.2\ngenerations = 5\nants = 6\n"
                                        "beta = 7\nrho = 0.08\nshortest_first = 0.9\niteration_best = 0.25\n"
                                        "max_unseen_mass = 0.01"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  const PlannerParameters& p = file.value().mission.planner;
  EXPECT_EQ(p.profile, SearchProfile::kPaper);
  EXPECT_EQ(p.heuristic, SearchHeuristic::kMts);
  EXPECT_EQ(p.cell_m, 0.1);
  EXPECT_EQ(p.spacing_m, 1.5);
  EXPECT_EQ(p.clearance_m, 0.2);
  EXPECT_EQ(p.generations, 5);
  EXPECT_EQ(p.ants, 6);
  EXPECT_EQ(p.beta, 7);
  EXPECT_EQ(p.rho, 0.08);
  EXPECT_EQ(p.shortest_first, 0.9);
  EXPECT_EQ(p.iteration_best, 0.25);
  EXPECT_EQ(p.max_unseen_mass, 0.01);
}

TEST(MissionFile, RemembersLinesForComplaintsThatComeLater) {
  const auto file = mission_of(kMission);
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file.value().lines.at("agent[1].start_m", "lies in an obstacle; expected free ground").message,
            file.value().path + ":17: agent[1].start_m: lies in an obstacle; expected free ground");
  EXPECT_EQ(file.value().lines.line_of("agent[1].preferred[1].polygon_m"), 22);
  EXPECT_EQ(file.value().lines.line_of("planner.spacing_m"), 3);
}

TEST(MissionFile, RefusesAnotherFormat) {
  EXPECT_EQ(complaint_about_mission("format = 1", "format = 2"),
            "m.toml:1: format: is another version of this file's form; expected 1");
  EXPECT_EQ(complaint_about_mission("format = 1", ""), "m.toml:1: format: missing; it must be given");
}

TEST(MissionFile, RefusesWhatIsMissing) {
  EXPECT_EQ(complaint_about_mission("map = '../maps/yard.toml'", ""), "m.toml:1: map: missing; it must be given");
  EXPECT_EQ(complaint_about_mission("start_m = [3, 4]", ""),
            "m.toml:13: agent[1].start_m: missing; it must be given, in metres");
  EXPECT_EQ(complaint_about_mission("robot = '../robots/r.toml'", ""),
            "m.toml:5: agent[0].robot: missing; it must be given");
  EXPECT_EQ(complaint_of("format = 1\nmap = 'a'\n"), "m.toml:1: agent: missing; it must be given");
}

TEST(MissionFile, RefusesValuesOutOfRange) {
  EXPECT_EQ(complaint_about_mission("speed_mps = 0.4", "speed_mps = 5"),
            "m.toml:11: agent[0].speed_mps: 5 is out of range; expected 0.05 to 3 (metres a second)");
  EXPECT_EQ(complaint_about_mission("start_m = [3, 4]", "start_m = [3, -4]"),
            "m.toml:17: agent[1].start_m[1]: -4 is out of range; expected 0 to 100000 (metres)");
  EXPECT_EQ(complaint_about_mission("cell_m = 0.5", "beta = 13"),
            "m.toml:4: planner.beta: 13 is out of range; expected 0 to 12");
  EXPECT_EQ(complaint_about_mission("cell_m = 0.5", "beta = 1.5"),
            "m.toml:4: planner.beta: 1.5 is a number; expected a whole number, 0 to 12");
  EXPECT_EQ(complaint_about_mission("cell_m = 0.5", "profile = 'quick'"),
            "m.toml:4: planner.profile: \"quick\" is unknown; expected \"paper\" or \"fast\"");
  EXPECT_EQ(complaint_about_mission("cell_m = 0.5", "heuristic = 'tps'"),
            "m.toml:4: planner.heuristic: \"tps\" is unknown; expected \"tsp\" or \"mts\"");
  EXPECT_EQ(complaint_about_mission("cell_m = 0.5", "rho = nan"),
            "m.toml:4: planner.rho: nan is not a finite number; expected a number, 0.000001 to 1");
  EXPECT_EQ(complaint_about_mission("[planner]", "seed = -1\n[planner]"),
            "m.toml:3: seed: -1 is out of range; expected 0 to 9223372036854775807");
}

TEST(MissionFile, RefusesOtherUnitsAndMisspeltKeys) {
  EXPECT_EQ(complaint_about_mission("speed_mps = 0.4", "speed_kmh = 2"),
            "m.toml:11: agent[0].speed_kmh: unknown; this quantity is given as speed_mps, in metres a second");
  EXPECT_EQ(complaint_about_mission("prefer", "perfer"),
            "m.toml:20: agent[1].perferred: unknown; did you mean preferred?");
  EXPECT_EQ(complaint_about_mission("[planner]", "[planer]"), "m.toml:3: planer: unknown; did you mean planner?");
}

TEST(MissionFile, RefusesATeamThatIsNotOneRobotAndThenPersons) {
  EXPECT_EQ(complaint_about_mission("kind = 'robot'\nrobot = '../robots/r.toml'", "kind = 'person'\n"),
            "m.toml:7: agent[0].kind: the first agent is a person; expected the robot first, then persons");
  EXPECT_EQ(complaint_about_mission("kind = 'person'\nmotion = 'reported'", "kind = 'robot'\nrobot = 'r.toml'"),
            "m.toml:15: agent[1].kind: a robot after the first agent; expected exactly one robot, the first agent");
  EXPECT_EQ(complaint_about_mission("kind = 'person'", "kind = 'dog'"),
            "m.toml:15: agent[1].kind: \"dog\" is unknown; expected \"robot\" or \"person\"");
}

TEST(MissionFile, RefusesOneNameForTwo) {
  EXPECT_EQ(complaint_about_mission("'Ana'", "'IVO'"),
            "m.toml:14: agent[1].name: \"IVO\" is another agent's name; expected a name of its own");
}

std::string team_of(int agents) {
  std::string text = kMission;
  for (int i = 2; i < agents; ++i) {
    text += "[[agent]]\nname = 'P" + std::to_string(i) +
            "'\nkind = 'person'\nstart_m = [3, 4]\nspeed_mps = 1\nsight_radius_m = 1\n";
  }
  return text;
}

TEST(MissionFile, RefusesMoreAgentsThanThePlannerHoldsWithTheProfileThatFits) {
  const int most = limits::kAgents;
  const std::string fits =
      most + 1 <= limits::Onboard::kAgents   ? "the planner profile that fits is onboard (-DIVO_PLANNER_PROFILE)"
      : most + 1 <= limits::Desktop::kAgents ? "the planner profile that fits is desktop (-DIVO_PLANNER_PROFILE)"
                                             : "no planner profile is that large";
  EXPECT_EQ(complaint_of(team_of(most + 1)), "m.toml:5: agent: has " + std::to_string(most + 1) +
                                                 " agents, more than this build's " + std::to_string(most) +
                                                 "; expected fewer; " + fits);
  EXPECT_EQ(complaint_of(team_of(9)), "m.toml:5: agent: has 9 agents, more than this build's " + std::to_string(most) +
                                          "; expected fewer; no planner profile is that large");
}

TEST(MissionFile, RefusesWhatBelongsToTheOtherKind) {
  EXPECT_EQ(complaint_about_mission("heading_deg = 180", "motion = 'reported'"),
            "m.toml:10: agent[0].motion: belongs to a person; a robot moves by its drives");
  EXPECT_EQ(complaint_about_mission("heading_deg = 180", "footprint_radius_m = 0.3"),
            "m.toml:10: agent[0].footprint_radius_m: belongs to a person; a robot's footprint is in its robot file");
  EXPECT_EQ(complaint_about_mission("motion = 'reported'", "heading_deg = 1"),
            "m.toml:16: agent[1].heading_deg: belongs to a robot; a person needs none");
  EXPECT_EQ(complaint_about_mission("motion = 'reported'", "robot = 'r.toml'"),
            "m.toml:16: agent[1].robot: belongs to a robot; a person has no robot file");
}

TEST(MissionFile, RefusesObjectsThatAreNone) {
  EXPECT_EQ(complaint_about_mission("[planner]", "object = 'lost'\n[planner]"),
            "m.toml:3: object: \"lost\" is unknown; expected \"drawn\" or \"unknown\"");
  EXPECT_EQ(complaint_about_mission("[planner]", "object = 3\n[planner]"),
            "m.toml:3: object: is no object; expected \"drawn\", \"unknown\" or [x, y]");
  EXPECT_EQ(complaint_about_mission("[planner]", "object = [3]\n[planner]"),
            "m.toml:3: object: has 1 element; expected a list of 2 numbers, [x, y]");
}

TEST(MissionFile, RefusesPriorsThatAreNone) {
  const std::string none =
      "m.toml:3: prior: is no prior; expected \"uniform\", { gaussians = [...] } or { image = \"...\", resolution_m = "
      "... }";
  EXPECT_EQ(complaint_about_prior("'flat'"), none);
  EXPECT_EQ(complaint_about_prior("7"), none);
  EXPECT_EQ(complaint_about_prior("{}"),
            "m.toml:3: prior: holds no prior; expected uniform, gaussians, or image and resolution_m");
  EXPECT_EQ(complaint_about_prior("{ image = 'x.png' }"),
            "m.toml:3: prior.resolution_m: missing; it must be given, in metres");
  EXPECT_EQ(complaint_about_prior("{ gaussians = [] }"),
            "m.toml:3: prior.gaussians: has 0 elements; expected a list of 1 to 64 Gaussians");
  EXPECT_EQ(complaint_about_prior("{ gaussians = [ { mean_m = [1, 1], sigma_m = 0 } ] }"),
            "m.toml:3: prior.gaussians[0].sigma_m: 0 is out of range; expected 0.01 to 10000 (metres)");
  EXPECT_EQ(complaint_about_prior("{ gaussians = [ { mean_m = [1, 1], sigma_m = 1, weight = 0 } ] }"),
            "m.toml:3: prior.gaussians[0].weight: 0 is out of range; expected 0.000001 to 1000000");
  EXPECT_EQ(complaint_about_prior("{ gaussians = [ { mean_m = [1, 1], sigma_m = 1 } ], image = 'x.png' }"),
            "m.toml:3: prior.image: a second prior beside gaussians; expected one of the two");
}

TEST(MissionFile, RefusesRectanglesWithoutArea) {
  const std::string empty =
      "m.toml:21: agent[1].preferred[0].rectangle_m: covers no area; expected [x0, y0, x1, y1] with x0 < x1 and y0 < "
      "y1";
  EXPECT_EQ(complaint_about_mission("[1, 2, 3, 5]", "[3, 2, 1, 5]"), empty);
  EXPECT_EQ(complaint_about_mission("[1, 2, 3, 5]", "[1, 2, 3, 2]"), empty);
  EXPECT_EQ(
      complaint_about_mission("[1, 2, 3, 5]", "[1, 2, 3]"),
      "m.toml:21: agent[1].preferred[0].rectangle_m: has 3 elements; expected a list of 4 numbers, [x0, y0, x1, y1]");
}

TEST(MissionFile, RefusesPolygonsThatAreNotSimple) {
  const std::string at = "m.toml:22: agent[1].preferred[1].polygon_m: ";
  EXPECT_EQ(complaint_about_polygon("[[0, 0], [1, 1]]"),
            at + "has 2 elements; expected a list of 3 to 64 vertices, [[x, y], ...]");
  EXPECT_EQ(complaint_about_polygon("[[0, 0], [1, 1], [2, 2], [5, 5]]"), at + "covers no area; expected a polygon");
  EXPECT_EQ(complaint_about_polygon("[[0, 0], [4, 0], [4, 0], [2, 3]]"),
            at + "vertices 1 and 2 are the same; expected each vertex once");
  EXPECT_EQ(complaint_about_polygon("[[0, 0], [4, 0], [2, 3], [0, 0]]"),
            at + "vertices 3 and 0 are the same; expected each vertex once");
  const std::string crossing = "; expected a polygon whose sides meet only at its vertices";
  EXPECT_EQ(complaint_about_polygon("[[0, 0], [4, 4], [4, 0], [0, 4]]"),
            at + "crosses itself: sides 0 and 2 meet" + crossing);
  EXPECT_EQ(complaint_about_polygon("[[0, 0], [4, 0], [2, 0], [2, 3]]"),
            at + "crosses itself: sides 0 and 1 meet" + crossing);
  EXPECT_EQ(complaint_about_polygon("[[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]]"),
            at + "crosses itself: sides 0 and 2 meet" + crossing);
}

TEST(MissionFile, AcceptsConcavePolygonsOfEitherTurn) {
  EXPECT_TRUE(
      mission_of(replaced(kMission, "[[0, 0], [4, 0], [2, 3]]", "[[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]]")).ok());
  EXPECT_TRUE(
      mission_of(replaced(kMission, "[[0, 0], [4, 0], [2, 3]]", "[[0, 4], [2, 1], [4, 4], [4, 0], [0, 0]]")).ok());
}

TEST(MissionFile, RefusesAreasThatAreNeitherOrBoth) {
  const std::string neither =
      "m.toml:21: agent[1].preferred[0]: is no area; expected either rectangle_m = [x0, y0, x1, y1] or polygon_m = "
      "[[x, y], "
      "...]";
  EXPECT_EQ(complaint_about_mission("{ rectangle_m = [1, 2, 3, 5] }", "{}"), neither);
  EXPECT_EQ(complaint_about_mission("rectangle_m = [1, 2, 3, 5]",
                                    "rectangle_m = [1, 2, 3, 5], polygon_m = [[0, 0], [4, 0], [2, 3]]"),
            neither);
  EXPECT_EQ(complaint_about_mission("{ rectangle_m = [1, 2, 3, 5] }", "5"),
            "m.toml:21: agent[1].preferred[0]: 5 is a number; expected a table");
}

}  // namespace
}  // namespace ivo::firmware
