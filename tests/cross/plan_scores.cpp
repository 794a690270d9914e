// plan_scores make: plans on this build's arithmetic, to standard output, a line an agent: CASE AGENT X Y X Y ...
// plan_scores score: reads such lines, each with a word before it that tells several plans of a case apart, and says
// what this build's path scorer gives each: WORD CASE ET ET_c EST UNSEEN. plan_scores_test.py gives one build's plans
// to two.
#include <array>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "planner/search/path_score.hpp"
#include "tests/cross/large_case.hpp"
#include "tests/cross/paper_case.hpp"

namespace ivo {
namespace {

constexpr double kMaxUnseen = 0.014;

struct PlannedCase {
  std::string name;
  cross::PaperRow row;
  bool courtyard = false;
};

// The last one is as the shipped courtyard mission: slow, unlike agents, one of whom would rather search an area.
const std::array<PlannedCase, 4> kPlanned = {{{"M1/U", {}},
                                              {"M1/G/S", {.peaked = true, .sub_priors = true}},
                                              {"M2/U", {.m2 = true}},
                                              {"courtyard", {.m2 = true, .peaked = true}, true}}};

using enum cross::LargePrior;
using enum cross::LargeSubPriors;
// Of the last three, the masses of large areas are rounded alike, by as much as half a unit of a thousand.
const std::array<cross::LargeRow, 7> kLarge = {
    {{.name = "large/U", .side_m = 400.0},
     {.name = "large/G", .prior = kFarGaussian},
     {.name = "large/U/S", .sub_priors = kAlike},
     {.name = "large/GG/S", .prior = kTwoGaussians, .sub_priors = kDealt},
     {.name = "large/spot", .side_m = 400.0, .prior = kSpot},
     {.name = "large/U/one", .sub_priors = kPreferredByOne},
     {.name = "large/steps/both", .side_m = 400.0, .prior = kSteps, .sub_priors = kPreferredByBoth}}};

void change(const PlannedCase& c, planner::SearchProblem& problem) {
  problem.colony.generations = 40;
  if (c.courtyard) {
    problem.agents[0].speed_mps = 0.35;
    problem.agents[1].speed_mps = 0.5;
    problem.agents[1].preferred.resize(1);
    for (const Point p : {Point{20.0, 20.0}, Point{39.0, 20.0}, Point{39.0, 39.0}, Point{20.0, 39.0}}) {
      IVO_CONTRACT(problem.agents[1].preferred[0].push_back(p));
    }
  }
}

bool prepare(planner::Planner& planner, const planner::SearchProblem& problem) {
  if (const planner::Refusal refusal = planner.prepare(problem)) {
    std::fprintf(stderr, "plan_scores: refused with code %d\n", static_cast<int>(refusal.code));
    return false;
  }
  return true;
}

template <class Waypoints>
void say(const std::string& name, std::size_t agent, const Waypoints& waypoints) {
  std::printf("%s %zu", name.c_str(), agent);
  for (const Point p : waypoints) {
    std::printf(" %.17g %.17g", p.x_m, p.y_m);
  }
  std::printf("\n");
}

int make(planner::Planner& planner) {
  static planner::Plan plan;
  for (const PlannedCase& c : kPlanned) {
    cross::PaperCase paper(c.row);
    change(c, paper.problem());
    if (!prepare(planner, paper.problem())) {
      return 1;
    }
    while (!planner.step({1'000'000}).done) {
    }
    planner.best_plan(plan);
    for (std::size_t m = 0; m < plan.paths.size(); ++m) {
      say(c.name, m, plan.paths[m].waypoints);
    }
  }
  for (const cross::LargeRow& row : kLarge) {
    const std::vector<std::vector<Point>> ways = cross::LargeCase(row).ways();
    for (std::size_t m = 0; m < ways.size(); ++m) {
      say(row.name, m, ways[m]);
    }
  }
  return 0;
}

using Ways = std::vector<std::vector<Point>>;
/// By case, and then by the word before it.
using Plans = std::map<std::string, std::map<std::string, Ways>>;

Plans read_plans() {
  Plans plans;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string word;
    std::string name;
    std::size_t agent = 0;
    words >> word >> name >> agent;
    Ways& ways = plans[name][word];
    ways.resize(2);
    for (Point p; words >> p.x_m >> p.y_m;) {
      ways.at(agent).push_back(p);
    }
  }
  return plans;
}

// False when the problem is refused.
bool score(planner::Planner& planner, const planner::SearchProblem& problem, const std::string& name,
           const std::map<std::string, Ways>& plans) {
  static planner::FirstSightings sightings;
  static planner::PathScorer scorer(sightings);
  if (!prepare(planner, problem)) {
    return false;
  }
  for (const auto& [word, ways] : plans) {
    std::vector<planner::WaypointPath> paths;
    for (std::size_t m = 0; m < ways.size(); ++m) {
      const planner::SearchAgent& agent = problem.agents[m];
      paths.push_back({ways[m], agent.speed_mps, agent.sight_radius_m});
    }
    const planner::PlanScore s = scorer.score(planner.cells(), planner.belief(), paths, kMaxUnseen);
    std::printf("%s %s %.12g %.12g %.12g %.12g\n", word.c_str(), name.c_str(), s.expected_time_s,
                s.expected_time_continuous_s, s.expected_sub_prior_time_s, s.unseen_mass);
  }
  return true;
}

int score(planner::Planner& planner) {
  Plans plans = read_plans();
  for (const PlannedCase& c : kPlanned) {
    cross::PaperCase paper(c.row);
    change(c, paper.problem());
    if (!score(planner, paper.problem(), c.name, plans[c.name])) {
      return 1;
    }
  }
  for (const cross::LargeRow& row : kLarge) {
    const cross::LargeCase large(row);
    if (!score(planner, large.problem(), row.name, plans[row.name])) {
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace ivo

int main(int argc, char** argv) {
  const std::string_view what = argc == 2 ? argv[1] : "";
  static ivo::planner::Planner planner;
  if (what == "make") {
    return ivo::make(planner);
  }
  if (what == "score") {
    return ivo::score(planner);
  }
  std::fprintf(stderr, "plan_scores: expected make or score\n");
  return 2;
}
