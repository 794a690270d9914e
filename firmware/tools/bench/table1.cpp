// The paper's Table I: 400 generations of 10 ants in the paper's profile, means of 10 trials.
#include <optional>

#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/trial.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

struct Published {
  double expected_time_s;
  double computing_time_s;
  double path_distance_m;
};

struct Table1Row {
  PaperMap map;
  PaperPrior prior;
  std::optional<Published> tsp;  ///< Gil and Sanfeliu, RA-L 2024, Table I
  std::optional<Published> mts;
};

using enum PaperMap;
using enum PaperPrior;

const std::vector<Table1Row>& rows() {
  static const std::vector<Table1Row> kRows = {
      {kM1, kUniform, {{80.98, 44, 371.42}}, {{94.60, 168, 839.45}}},
      {kM1, kUniformSubPriors, {{84.14, 47, 361.05}}, {{116.95, 184, 730.43}}},
      {kM1, kGaussians, {{39.33, 44, 419.67}}, {{37.01, 156, 785.91}}},
      {kM1, kGaussiansSubPriors, {{38.77, 48, 416.46}}, {{35.15, 184, 828.24}}},
      {kM1, kGaussiansExchanged, {}, {}},
      {kM2, kUniform, {{142.23, 116, 673.88}}, {{165.32, 460, 1202.69}}},
      {kM2, kUniformSubPriors, {{155.47, 123, 685}}, {{237.15, 560, 1129.86}}},
      {kM2, kGaussians, {{75.04, 112, 621.16}}, {{92.53, 452, 1098.57}}},
      {kM2, kGaussiansSubPriors, {{80.50, 136, 655.41}}, {{86.32, 544, 1176.21}}},
      {kM2, kGaussiansExchanged, {}, {}},
  };
  return kRows;
}

constexpr double kPaperRho = 0.002;

double cell_m(const Options& options) { return options.quick ? 0.5 : 0.25; }

struct Table1Case {
  Table1Row row;
  planner::Heuristic heuristic;
  double spacing_m;
  std::string name;
  std::vector<Result<Found>> trials;
};

std::vector<Table1Case> cases_of(const Options& options, std::size_t trials) {
  std::vector<Table1Case> cases;
  for (const double spacing_m : options.quick ? std::vector{5.0} : std::vector{5.0, 3.5}) {
    for (const planner::Heuristic heuristic : {planner::Heuristic::kTsp, planner::Heuristic::kMts}) {
      for (const Table1Row& row : rows()) {
        cases.push_back({row, heuristic, spacing_m, {}, std::vector<Result<Found>>(trials, Error{})});
      }
    }
  }
  return cases;
}

std::vector<double> all(const std::vector<Result<Found>>& trials, double (*of)(const Found&)) {
  std::vector<double> values;
  values.reserve(trials.size());
  for (const Result<Found>& trial : trials) {
    values.push_back(of(trial.value()));
  }
  return values;
}

void add_case(const Table1Case& c, double given_s, Sheet& sheet) {
  if (!c.trials.front()) {
    sheet.skip(c.name, c.trials.front().error().message);
    return;
  }
  const std::vector<double> expected_s = all(c.trials, [](const Found& f) { return f.score.expected_time_s; });
  const std::vector<double> search_s = all(c.trials, [](const Found& f) { return f.search_s; });
  const std::vector<double> length_m = all(c.trials, [](const Found& f) { return f.length_m; });
  const auto& published = c.heuristic == planner::Heuristic::kTsp ? c.row.tsp : c.row.mts;
  sheet.add_mean(c.name, "ET", expected_s, "s");
  if (published) {
    sheet.add(c.name, "paper's", published->expected_time_s, "s");
  }
  sheet.add_mean(c.name, "ET_c", all(c.trials, [](const Found& f) { return f.score.expected_time_continuous_s; }), "s");
  sheet.add_mean(c.name, "unseen", all(c.trials, [](const Found& f) { return 100 * f.score.unseen_mass; }), "%");
  sheet.add_mean(c.name, "CT", search_s, "s");
  if (published) {
    sheet.add(c.name, "paper's CT", published->computing_time_s, "s");
  }
  sheet.add(c.name, "PD", mean(length_m), "m");
  if (published) {
    sheet.add(c.name, "paper's PD", published->path_distance_m, "m");
  }
  const double complete = 100 * mean(all(c.trials, [](const Found& f) { return f.score.complete ? 1.0 : 0.0; }));
  sheet.add(c.name, "complete", complete, "%");
  if (c.row.prior == kGaussiansExchanged && given_s > 0.0) {
    sheet.add(
        c.name, "ET over G/S", mean(expected_s) / given_s, "",
        complete < 100 ? std::nullopt : std::optional(Target{1.2, Sense::kAtLeast}));  // only complete plans compare
  }
}

}  // namespace

void table1(const Options& options, Sheet& sheet) {
  const std::size_t trials = options.quick ? 2 : 10;
  std::vector<Table1Case> cases = cases_of(options, trials);
  Cores cores;
  cores.each(cases.size() * trials, "table1", [&](std::size_t i, planner::Planner& planner) {
    Table1Case& c = cases[i / trials];
    Result<Scene> scene = paper_scene(c.row.map, c.row.prior, c.spacing_m);
    if (!scene) {
      c.trials[i % trials] = scene.error();
      return;
    }
    planner::SearchProblem& problem = scene.value().problem;
    problem.cell_m = cell_m(options);
    problem.colony.profile = planner::Profile::kPaper;
    problem.colony.heuristic = c.heuristic;
    problem.colony.rho = kPaperRho;
    problem.colony.generations = options.quick ? 5 : 400;
    problem.colony.ants = 10;
    problem.colony.seed = 1 + i % trials;
    c.trials[i % trials] = search_to_end(planner, problem);
  });
  double given_s = 0.0;
  for (Table1Case& c : cases) {
    const Result<Scene> scene = paper_scene(c.row.map, c.row.prior, c.spacing_m);
    c.name = (scene ? scene.value().name : "M2") +
             (c.heuristic == planner::Heuristic::kTsp ? " TSP" : " MTS (our reading)") +
             format(", %.1f m, cells %.2f m", c.spacing_m, cell_m(options));
    add_case(c, given_s, sheet);
    const bool given = c.row.prior == kGaussiansSubPriors && c.trials.front().ok();
    given_s = given ? mean(all(c.trials, [](const Found& f) { return f.score.expected_time_s; })) : 0.0;
  }
}

}  // namespace ivo::firmware::bench
