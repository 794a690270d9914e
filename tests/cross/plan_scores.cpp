// plan_scores make: plans on this build's arithmetic, to standard output, a line an agent: CASE AGENT X Y X Y ...
// plan_scores score: reads such lines and says what this build's path scorer gives each case: CASE ET ET_c EST UNSEEN.
// plan_scores_test.py gives one build's plans to two.
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
#include "tests/cross/paper_case.hpp"

namespace ivo {
namespace {

constexpr double kMaxUnseen = 0.014;

struct ScoredCase {
  std::string name;
  cross::PaperRow row;
  bool courtyard = false;
};

// The last one is as the shipped courtyard mission: slow, unlike agents, one of whom would rather search an area.
const std::array<ScoredCase, 4> kCases = {{{"M1/U", {}},
                                           {"M1/G/S", {.peaked = true, .sub_priors = true}},
                                           {"M2/U", {.m2 = true}},
                                           {"courtyard", {.m2 = true, .peaked = true}, true}}};

void change(const ScoredCase& c, planner::SearchProblem& problem) {
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

int make(planner::Planner& planner) {
  static planner::Plan plan;
  for (const ScoredCase& c : kCases) {
    cross::PaperCase paper(c.row);
    change(c, paper.problem());
    if (!prepare(planner, paper.problem())) {
      return 1;
    }
    while (!planner.step({1'000'000}).done) {
    }
    planner.best_plan(plan);
    for (std::size_t m = 0; m < plan.paths.size(); ++m) {
      std::printf("%s %zu", c.name.c_str(), m);
      for (const Point p : plan.paths[m].waypoints) {
        std::printf(" %.17g %.17g", p.x_m, p.y_m);
      }
      std::printf("\n");
    }
  }
  return 0;
}

using Ways = std::vector<std::vector<Point>>;

std::map<std::string, Ways> read_plans() {
  std::map<std::string, Ways> plans;
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string name;
    std::size_t agent = 0;
    words >> name >> agent;
    Ways& ways = plans[name];
    ways.resize(2);
    for (Point p; words >> p.x_m >> p.y_m;) {
      ways.at(agent).push_back(p);
    }
  }
  return plans;
}

int score(planner::Planner& planner) {
  static planner::FirstSightings sightings;
  static planner::PathScorer scorer(sightings);
  const std::map<std::string, Ways> plans = read_plans();
  for (const ScoredCase& c : kCases) {
    cross::PaperCase paper(c.row);
    change(c, paper.problem());
    const auto plan = plans.find(c.name);
    if (plan == plans.end() || !prepare(planner, paper.problem())) {
      return 1;
    }
    std::vector<planner::WaypointPath> paths;
    for (std::size_t m = 0; m < plan->second.size(); ++m) {
      const planner::SearchAgent& agent = paper.problem().agents[m];
      paths.push_back({plan->second[m], agent.speed_mps, agent.sight_radius_m});
    }
    const planner::PlanScore s = scorer.score(planner.cells(), planner.belief(), paths, kMaxUnseen);
    std::printf("%s %.12g %.12g %.12g %.12g\n", c.name.c_str(), s.expected_time_s, s.expected_time_continuous_s,
                s.expected_sub_prior_time_s, s.unseen_mass);
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
