// ivo-naive [--map m1|m2] [--generations N] [--ants N] [--json FILE]: how much faster the planner's paper profile is
// than a planner without tables (tests/support/naive_planner.hpp): the same decisions on M1/U or M2/U at 3.5 m and
// 0.25 m cells, in one run, by processor time, what is built before the search apart. FILE - is standard output, and
// then nothing else is written there: `ivo bench speed` reads it so. Ends with 1 when the two plans differ, 2 on wrong
// input.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/files/text_file.hpp"
#include "firmware/tools/bench/bench_report.hpp"
#include "firmware/tools/bench/trial.hpp"
#include "firmware/tools/exit_status.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/terminal.hpp"
#include "tests/support/naive_planner.hpp"

namespace {

using namespace ivo;

struct Options {
  firmware::bench::PaperMap map = firmware::bench::PaperMap::kM1;
  int generations = 4;  // what the planner builds at first use is a large part of fewer
  int ants = 10;
  std::string json;
};

bool read(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    if (i + 1 == argc) {
      return false;
    }
    const std::string_view value = argv[i + 1];
    if (name == "--json") {
      options.json = value;
      continue;
    }
    if (name == "--map") {
      if (value != "m1" && value != "m2") {
        return false;
      }
      options.map = value == "m1" ? firmware::bench::PaperMap::kM1 : firmware::bench::PaperMap::kM2;
      continue;
    }
    int* const number = name == "--generations" ? &options.generations : name == "--ants" ? &options.ants : nullptr;
    if (number == nullptr) {
      return false;
    }
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), *number);
    if (error != std::errc{} || end != value.data() + value.size() || *number < 1 || *number > 10'000) {
      return false;
    }
  }
  return true;
}

bool same(const planner::Plan& plan, const test::NaivePlan& naive) {
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-9; };
  bool same = near(plan.score.expected_time_s, naive.score.expected_time_s) &&
              near(plan.score.unseen_mass, naive.score.unseen_mass) && plan.paths.size() == naive.waypoints.size();
  for (std::size_t m = 0; same && m < naive.waypoints.size(); ++m) {
    same = std::equal(plan.paths[m].waypoints.begin(), plan.paths[m].waypoints.end(), naive.waypoints[m].begin(),
                      naive.waypoints[m].end(),
                      [&](Point a, Point b) { return near(a.x_m, b.x_m) && near(a.y_m, b.y_m); });
  }
  return same;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace firmware;
  Options options;
  if (!read(argc, argv, options)) {
    (void)std::fprintf(
        stderr, "ivo-naive: expected [--map m1|m2] [--generations N] [--ants N] [--json FILE], N from 1 to 10000\n");
    return exit_status::kWrongInput;
  }
  const Result<bench::Scene> scene = bench::paper_scene(options.map, bench::PaperPrior::kUniform, 3.5);
  if (!scene) {
    (void)std::fprintf(stderr, "ivo-naive: %s\n", scene.error().message.c_str());
    return exit_status::kWrongInput;
  }
  planner::SearchProblem problem = scene.value().problem;
  problem.colony.profile = planner::Profile::kPaper;
  problem.colony.generations = options.generations;
  problem.colony.ants = options.ants;

  constexpr int kRuns = 9;  // the planner's few milliseconds are hard to measure once
  const auto planner = firmware::make_planner();
  std::vector<double> planner_s;
  planner_s.reserve(kRuns);
  for (int run = 0; run < kRuns; ++run) {
    planner_s.push_back(bench::search_to_end(*planner, problem).value().search_s);
  }
  const auto plan = std::make_unique<planner::Plan>();
  planner->best_plan(*plan);

  const double begin_s = bench::thread_seconds();
  const test::NaivePlan naive = test::NaivePlanner(*planner, problem).plan();
  const double naive_s = bench::thread_seconds() - begin_s;

  const double ants = options.generations * options.ants;
  std::nth_element(planner_s.begin(), planner_s.begin() + kRuns / 2, planner_s.end());
  const double median_s = planner_s[kRuns / 2];
  const double worst_s = *std::max_element(planner_s.begin(), planner_s.end());
  bench::Sheet sheet("naive");
  const std::string name = scene.value().name + ", 3.5 m, " + counted(options.generations, "generation") + " of " +
                           counted(options.ants, "ant");
  sheet.add(name, "planner, an ant", 1e6 * median_s / ants, "us");
  sheet.add(name, "planner, an ant, worst", 1e6 * worst_s / ants, "us");
  sheet.add(name, "naive planner, an ant", 1e6 * naive_s / ants, "us");
  sheet.add(name, "times as fast", naive_s / median_s, "", bench::Target{100.0, bench::Sense::kAtLeast});
  sheet.add(name, "times as fast, worst", naive_s / worst_s, "");
  const bool for_programs = options.json == "-";
  (void)std::printf("%s", (for_programs ? bench::json_of(sheet.records()) : bench::table_of(sheet.records())).c_str());
  if (!same(*plan, naive)) {
    (void)std::fprintf(stderr, "ivo-naive: the two planners' plans differ; expected the same from the same seed\n");
    return exit_status::kFaultOrStop;
  }
  if (!options.json.empty() && !for_programs && !write_file(options.json, bench::json_of(sheet.records()))) {
    (void)std::fprintf(stderr, "ivo-naive: %s: not written\n", options.json.c_str());
    return exit_status::kFaultOrStop;
  }
  return exit_status::kEnded;
}
