#include "firmware/files/plan_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "firmware/files/report_file.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/complaint.hpp"

namespace ivo::firmware {
namespace {

PlanDocument plan() {
  PlanDocument plan;
  plan.mission = "yard \"north\"";
  plan.map = "config/maps/courtyard.toml";
  plan.seed = std::numeric_limits<std::uint64_t>::max();
  plan.profile = SearchProfile::kPaper;
  plan.heuristic = SearchHeuristic::kMts;
  plan.threads = 2;
  plan.capacity = "onboard";
  plan.cell_m = 0.25;
  plan.spacing_m = 3.5;
  plan.nodes = 144;
  plan.generations_done = 400;
  plan.unobservable_share = 0.1;
  plan.bounds = {65.5, 60.25, 70.0, 64.125, 0.125};
  plan.score = {81.25, 81.75, 1.0 / 3.0, 0.0139, 245.5, true};
  plan.agents = {{"IVO", AgentKind::kRobot, 0.35, 2.5, 42.0, 120.0, {{1.75, 1.75}, {0.1 + 0.2, 5.25}}},
                 {"Ana", AgentKind::kPerson, 0.5, 3.0, 1e-9, 0.0, {{39.25, 1.75}}}};
  return plan;
}

std::string complaint_about_plan(std::string_view from, std::string_view to) {
  const ScratchFolder folder;
  return replaced(message_of(read_plan(folder.put("p.json", replaced(plan_json(plan()), from, to)))),
                  folder.path() + "/", "");
}

TEST(PlanFile, ReadsBackWhatItWroteToTheLastBit) {
  const ScratchFolder folder;
  const auto read = read_plan(folder.put("p.json", plan_json(plan())));
  ASSERT_TRUE(read.ok()) << read.error().message;
  const PlanDocument& back = read.value();
  const PlanDocument there = plan();
  EXPECT_EQ(back.mission, there.mission);
  EXPECT_EQ(back.map, there.map);
  EXPECT_EQ(back.seed, there.seed);
  EXPECT_EQ(back.profile, there.profile);
  EXPECT_EQ(back.heuristic, there.heuristic);
  EXPECT_EQ(back.threads, there.threads);
  EXPECT_EQ(back.capacity, there.capacity);
  EXPECT_EQ(back.bounds.area_s, there.bounds.area_s);
  EXPECT_EQ(back.bounds.area_strict_s, there.bounds.area_strict_s);
  EXPECT_EQ(back.bounds.reach_s, there.bounds.reach_s);
  EXPECT_EQ(back.bounds.reach_strict_s, there.bounds.reach_strict_s);
  EXPECT_EQ(back.bounds.gap, there.bounds.gap);
  EXPECT_EQ(back.cell_m, there.cell_m);
  EXPECT_EQ(back.spacing_m, there.spacing_m);
  EXPECT_EQ(back.nodes, there.nodes);
  EXPECT_EQ(back.generations_done, there.generations_done);
  EXPECT_EQ(back.unobservable_share, there.unobservable_share);
  EXPECT_EQ(back.score.expected_time_s, there.score.expected_time_s);
  EXPECT_EQ(back.score.expected_time_continuous_s, there.score.expected_time_continuous_s);
  EXPECT_EQ(back.score.expected_sub_prior_time_s, there.score.expected_sub_prior_time_s);
  EXPECT_EQ(back.score.unseen_mass, there.score.unseen_mass);
  EXPECT_EQ(back.score.horizon_s, there.score.horizon_s);
  EXPECT_EQ(back.score.complete, there.score.complete);
  ASSERT_EQ(back.agents.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.agents[i].name, there.agents[i].name);
    EXPECT_EQ(back.agents[i].kind, there.agents[i].kind);
    EXPECT_EQ(back.agents[i].speed_mps, there.agents[i].speed_mps);
    EXPECT_EQ(back.agents[i].sight_radius_m, there.agents[i].sight_radius_m);
    EXPECT_EQ(back.agents[i].length_m, there.agents[i].length_m);
    EXPECT_EQ(back.agents[i].duration_s, there.agents[i].duration_s);
    EXPECT_EQ(back.agents[i].waypoints, there.agents[i].waypoints);
  }
  EXPECT_EQ(plan_json(back), plan_json(there));
}

TEST(PlanFile, WritesShortNumbersInAFixedOrder) {
  PlanDocument small = plan();
  small.seed = 7;
  small.agents.pop_back();
  EXPECT_EQ(plan_json(small),
            "{\n"
            "  \"format\": 2,\n"
            "  \"mission\": \"yard \\\"north\\\"\",\n"
            "  \"map\": \"config/maps/courtyard.toml\",\n"
            "  \"seed\": 7,\n"
            "  \"profile\": \"paper\",\n"
            "  \"heuristic\": \"mts\",\n"
            "  \"threads\": 2,\n"
            "  \"capacity\": \"onboard\",\n"
            "  \"cell_m\": 0.25,\n"
            "  \"spacing_m\": 3.5,\n"
            "  \"nodes\": 144,\n"
            "  \"generations_done\": 400,\n"
            "  \"unobservable_share\": 0.1,\n"
            "  \"score\": {\"expected_time_s\":81.25,\"expected_time_continuous_s\":81.75,"
            "\"expected_sub_prior_time_s\":0.3333333333333333,\"unseen_mass\":0.0139,\"horizon_s\":245.5,"
            "\"complete\":true},\n"
            "  \"bounds\": {\"area_s\":65.5,\"area_strict_s\":60.25,\"reach_s\":70.0,\"reach_strict_s\":64.125},\n"
            "  \"gap\": 0.125,\n"
            "  \"agents\": [\n"
            "    {\"name\":\"IVO\",\"kind\":\"robot\",\"speed_mps\":0.35,\"sight_radius_m\":2.5,\"length_m\":42.0,"
            "\"duration_s\":120.0,\"waypoints_m\":[[1.75,1.75],[0.30000000000000004,5.25]]}\n"
            "  ]\n"
            "}\n");
}

TEST(PlanFile, SurvivesANameThatIsNotUtf8) {
  PlanDocument odd = plan();
  odd.mission = "caf\xe9";
  EXPECT_NE(plan_json(odd).find("caf\xef\xbf\xbd"), std::string::npos);
}

TEST(PlanFile, RefusesWhatIsNoPlan) {
  const ScratchFolder folder;
  EXPECT_EQ(message_of(read_plan(folder.path("p.json"))),
            folder.path("p.json") + ": cannot be read: No such file or directory; expected a plan");
  EXPECT_EQ(message_of(read_plan(folder.put("p.json", "{\"format\": 1"))),
            folder.path("p.json") + ":1: not JSON: ends too early; expected a plan");
  EXPECT_EQ(message_of(read_plan(folder.put("p.json", "[1]"))),
            folder.path("p.json") + ": is no object; expected what plan writes");
  EXPECT_EQ(complaint_about_plan("\"format\": 2", "\"format\": 1"),
            "p.json: format: 1 is another version of this file's form; expected 2");
}

TEST(PlanFile, RefusesFieldsThatAreMissingOrOfTheWrongType) {
  EXPECT_EQ(complaint_about_plan("\"cell_m\"", "\"cell_cm\""), "p.json: cell_m: missing; it must be given");
  EXPECT_EQ(complaint_about_plan("\"seed\": 18446744073709551615", "\"seed\": -1"),
            "p.json: seed: is no count; expected a whole number, 0 to 18446744073709551615");
  EXPECT_EQ(complaint_about_plan("\"capacity\": \"onboard\"", "\"capacity\": 3"),
            "p.json: capacity: is no text; expected text");
  EXPECT_EQ(complaint_about_plan("\"profile\": \"paper\"", "\"profile\": \"onboard\""),
            "p.json: profile: \"onboard\" is unknown; expected \"paper\" or \"fast\"");
  EXPECT_EQ(complaint_about_plan("\"gap\": 0.125", "\"gap\": \"x\""),
            "p.json: gap: this will not do; expected a number, -1 to 1000000000");
  EXPECT_EQ(complaint_about_plan("\"complete\":true", "\"complete\":1"),
            "p.json: score.complete: is no flag; expected true or false");
  EXPECT_EQ(complaint_about_plan("\"unseen_mass\":0.0139", "\"unseen_mass\":1.5"),
            "p.json: score.unseen_mass: 1.5 will not do; expected a number, 0 to 1");
  EXPECT_EQ(complaint_about_plan("\"score\": {", "\"score\": 5, \"x\": {"),
            "p.json: score.expected_time_s: missing; it must be given");
}

TEST(PlanFile, RefusesAgentsAndWaypointsThatAreNone) {
  EXPECT_EQ(complaint_about_plan("\"kind\":\"person\"", "\"kind\":\"dog\""),
            "p.json: agents[1].kind: \"dog\" is unknown; expected \"robot\" or \"person\"");
  EXPECT_EQ(complaint_about_plan("[[39.25,1.75]]", "[]"),
            "p.json: agents[1].waypoints_m: is empty; expected a list of at least one");
  EXPECT_EQ(complaint_about_plan("[1.75,1.75],", "[1.75],"),
            "p.json: agents[0].waypoints_m[0]: is no point; expected [x, y]");
  EXPECT_EQ(complaint_about_plan("[1.75,1.75],", "[1.75,null],"),
            "p.json: agents[0].waypoints_m[0]: this will not do; expected a number, -1000000 to 1000000");
  EXPECT_EQ(complaint_about_plan("\"agents\": [", "\"agents\": {}, \"y\": ["),
            "p.json: agents: is no list; expected a list of at least one");
}

std::string paths_complaint(const std::string& text) {
  const ScratchFolder folder;
  return replaced(message_of(read_paths(folder.put("p.json", text))), folder.path() + "/", "");
}

TEST(PlanFile, ReadsThePathsOfAnyPlanAndTrustsNothingElse) {
  const ScratchFolder folder;
  const auto ours = read_paths(folder.put("p.json", plan_json(plan())));
  ASSERT_TRUE(ours.ok()) << ours.error().message;
  ASSERT_EQ(ours.value().size(), 2U);
  EXPECT_EQ(ours.value()[0].agent, "IVO");
  EXPECT_EQ(ours.value()[0].waypoints, plan().agents[0].waypoints);
  const auto bare = read_paths(folder.put(
      "p.json", R"({"format": "other", "score": 3, "agents": [{"waypoints_m": [[1, 2], [3.5, 4e0]], "kind": 7}]})"));
  ASSERT_TRUE(bare.ok()) << bare.error().message;
  EXPECT_FALSE(bare.value()[0].agent.has_value());
  EXPECT_EQ(bare.value()[0].waypoints, (std::vector<Point>{{1, 2}, {3.5, 4}}));
}

TEST(PlanFile, RefusesPathsThatAreNone) {
  EXPECT_EQ(paths_complaint("[]"), "p.json: is no object; expected { \"agents\": [...] }");
  EXPECT_EQ(paths_complaint("{}"), "p.json: agents: missing; it must be given");
  EXPECT_EQ(paths_complaint(R"({"agents": [{"name": "IVO"}]})"),
            "p.json: agents[0].waypoints_m: missing; it must be given");
  EXPECT_EQ(paths_complaint(R"({"agents": [7]})"), "p.json: agents[0].waypoints_m: missing; it must be given");
  EXPECT_EQ(paths_complaint(R"({"agents": [{"name": 1, "waypoints_m": [[1, 2]]}]})"),
            "p.json: agents[0].name: is no text; expected text");
  EXPECT_EQ(paths_complaint(R"({"agents": [{"waypoints_m": [[1, 2], [1, null]]}]})"),
            "p.json: agents[0].waypoints_m[1]: this will not do; expected a number, -1000000 to 1000000");
  EXPECT_EQ(paths_complaint(R"({"agents": [{"waypoints_m": [[1, NaN]]}]})"),
            "p.json:1: not JSON: \"NaN]]}]}\" cannot stand here; expected a plan");
  EXPECT_EQ(paths_complaint(R"({"agents": [{"waypoints_m": [[1, 1e999]]}]})"),
            "p.json: holds a number beyond all bounds; expected finite numbers");
  EXPECT_EQ(paths_complaint(std::string(100'000, '[')), "p.json: nested deeper than 64 levels; expected a plan");
}

// Any cut of a plan and any one byte of it made another: refused or read, never a crash.
TEST(PlanFile, WithstandsDamage) {
  const ScratchFolder folder;
  const std::string whole = plan_json(plan());
  for (std::size_t i = 0; i + 2 < whole.size(); i += 7) {
    EXPECT_FALSE(read_plan(folder.put("p.json", whole.substr(0, i))).ok()) << i;
    EXPECT_FALSE(read_paths(folder.path("p.json")).ok()) << i;
    for (const char c : {'[', '"', '9', '\0'}) {
      std::string damaged = whole;
      damaged[i] = c;
      EXPECT_FALSE(message_of(read_plan(folder.put("p.json", damaged))).empty());
      (void)read_paths(folder.path("p.json"));
    }
  }
}

TEST(ReportFile, WritesAFindAndASearchWithoutOne) {
  ReportDocument report;
  report.mission = "m1";
  report.seed = 7;
  report.end = RunEnd::kFound;
  report.reason = "seen by Ana";
  report.finder = "Ana";
  report.object = Point{3.5, 4};
  report.score = ScoreDocument{81, 81.5, std::nullopt, 0.01, 200, true};
  report.bounds = BoundsDocument{60, 55, 72, 66, 0.125};
  report.real_search_time_s = 43.25;
  report.agents = {{"IVO", AgentKind::kRobot, 60, ReportedTrack{15.5, 0.34, {1, 2}}}};
  const std::string found = report_json(report);
  EXPECT_EQ(found,
            "{\n"
            "  \"format\": 1,\n"
            "  \"mission\": \"m1\",\n"
            "  \"seed\": 7,\n"
            "  \"end\": \"found\",\n"
            "  \"reason\": \"seen by Ana\",\n"
            "  \"finder\": \"Ana\",\n"
            "  \"object_m\": [3.5,4.0],\n"
            "  \"real_search_time_s\": 43.25,\n"
            "  \"plan_score\": {\"expected_time_s\":81.0,\"expected_time_continuous_s\":81.5,"
            "\"expected_sub_prior_time_s\":null,\"unseen_mass\":0.01,\"horizon_s\":200.0,\"complete\":true},\n"
            "  \"plan_bounds\": {\"area_s\":60.0,\"area_strict_s\":55.0,\"reach_s\":72.0,\"reach_strict_s\":66.0},\n"
            "  \"plan_gap\": 0.125,\n"
            "  \"agents\": [\n"
            "    {\"name\":\"IVO\",\"kind\":\"robot\",\"planned_length_m\":60.0,\"distance_m\":15.5,"
            "\"mean_speed_mps\":0.34,\"final_position_m\":[1.0,2.0]}\n"
            "  ],\n"
            "  \"drive_fault\": null\n"
            "}\n");
  report.end = RunEnd::kFault;
  report.finder.reset();
  report.object.reset();
  report.drive_fault = "drive 3: following error";
  const std::string fault = report_json(report);
  EXPECT_NE(fault.find("\"end\": \"fault\""), std::string::npos);
  EXPECT_NE(fault.find("\"finder\": null"), std::string::npos);
  EXPECT_NE(fault.find("\"object_m\": null"), std::string::npos);
  EXPECT_NE(fault.find("\"drive_fault\": \"drive 3: following error\""), std::string::npos);
}

TEST(ReportFile, NamesEveryEnd) {
  const std::pair<RunEnd, std::string> ends[] = {{RunEnd::kFound, "found"},
                                                 {RunEnd::kPathsEnded, "paths_ended"},
                                                 {RunEnd::kStopped, "stopped"},
                                                 {RunEnd::kFault, "fault"},
                                                 {RunEnd::kNoConsent, "no_consent"}};
  for (const auto& [end, word] : ends) {
    ReportDocument report;
    report.end = end;
    EXPECT_NE(report_json(report).find("\"end\": \"" + word + "\""), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace ivo::firmware
