// Ours beside four other planners at equal time of one core (rivals/rivals.hpp). Cells, graph, prior and sight table,
// and the rivals' bit masks over them, are built before; every plan is scored as `ivo score` does it.
#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "config/base/contract.hpp"
#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/rivals/rivals.hpp"
#include "firmware/tools/bench/trial.hpp"
#include "firmware/tools/terminal.hpp"
#include "planner/search/path_score.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr const char* kOurs = "ours";

struct Case {
  std::string name;
  Result<Scene> (*scene)(const Options& options);
  bool needs_data = false;
};

/// One planner's plans of one case and time, a seed each.
struct Column {
  explicit Column(std::string name) : planner(std::move(name)) {}

  std::string planner;
  std::vector<double> expected_s;  ///< ET_c of the complete plans
  double worst_unseen = 0.0;
  int plans = 0;
  int completed_greedily = 0;
  double longest_s = 0.0;
};

struct Comparison {
  std::string skipped;  ///< why, when it was
  int nodes = 0;
  double prepare_s = 0.0;
  double coverage_s = 0.0;
  double max_unseen_mass = 0.0;
  double bound_s = 0.0;                 ///< nominal, for a plan that just is complete
  std::vector<std::vector<Column>> at;  ///< of each time
};

void add_plan(Column& column, const planner::PlanScore& score, bool completed_greedily, double taken_s) {
  ++column.plans;
  if (score.complete) {
    column.expected_s.push_back(score.expected_time_continuous_s);
  }
  column.worst_unseen = std::max(column.worst_unseen, score.unseen_mass);
  column.completed_greedily += completed_greedily ? 1 : 0;
  column.longest_s = std::max(column.longest_s, taken_s);
}

planner::PlanScore score_of_best(const planner::Planner& planner, const planner::SearchProblem& problem,
                                 planner::PathScorer& scorer) {
  if (!planner.progress().has_plan) {
    return {};
  }
  const auto plan = std::make_unique<planner::Plan>();
  planner.best_plan(*plan);
  StaticVector<planner::WaypointPath, limits::kAgents> paths;
  for (std::size_t m = 0; m < problem.agents.size(); ++m) {
    (void)paths.push_back(
        {plan->paths[m].waypoints.span(), problem.agents[m].speed_mps, problem.agents[m].sight_radius_m});
  }
  return scorer.score(planner.cells(), planner.belief(), paths.span(), problem.colony.ant.max_unseen_mass);
}

/// The best plan after each of the times of one search, scored from its waypoints.
void run_ours(planner::Planner& planner, planner::SearchProblem problem, std::uint64_t seed,
              const std::vector<double>& times_s, planner::PathScorer& scorer, Comparison& comparison) {
  constexpr planner::Budget kPart{2'000};
  problem.colony.profile = planner::Profile::kFast;
  problem.colony.rho = 0.02;
  problem.colony.generations = std::numeric_limits<int>::max();
  problem.colony.seed = seed;
  IVO_CONTRACT(!planner.prepare(problem));  // it was prepared before
  double searched_s = 0.0;
  for (std::size_t t = 0; t < times_s.size(); ++t) {
    const double begin_s = thread_seconds() - searched_s;
    while (thread_seconds() - begin_s < times_s[t] && !planner.step(kPart).done) {
    }
    searched_s = thread_seconds() - begin_s;
    add_plan(comparison.at[t].front(), score_of_best(planner, problem, scorer), false, searched_s);
  }
}

Comparison run(planner::Planner& planner, const Case& c, const Options& options, const std::vector<double>& times_s) {
  const std::uint64_t seeds = options.quick || c.needs_data ? 2 : 5;  // a large map's graph is built for each
  Comparison comparison;
  if (c.needs_data && options.data.empty()) {
    comparison.skipped = "no --data folder";
    return comparison;
  }
  const Result<Scene> scene = c.scene(options);
  const Result<double> prepared = scene ? prepare(planner, scene.value().problem) : Result<double>(scene.error());
  if (!prepared) {
    comparison.skipped = prepared.error().message;
    return comparison;
  }
  const planner::SearchProblem& problem = scene.value().problem;
  comparison.prepare_s = prepared.value();
  comparison.nodes = planner.graph().nodes();
  comparison.max_unseen_mass = problem.colony.ant.max_unseen_mass;
  comparison.bound_s = planner.bounds(comparison.max_unseen_mass).bound_s();
  const double coverage_begin_s = thread_seconds();
  const rivals::Coverage coverage(planner, problem);
  comparison.coverage_s = thread_seconds() - coverage_begin_s;
  const auto sightings = std::make_unique<planner::FirstSightings>();
  const auto scorer = std::make_unique<planner::PathScorer>(*sightings);
  const rivals::RivalProblem rival_problem{planner, problem, coverage, *scorer};
  comparison.at.assign(times_s.size(), {Column(kOurs)});
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    run_ours(planner, problem, seed, times_s, *scorer, comparison);
  }
  for (std::size_t t = 0; t < times_s.size(); ++t) {
    for (const rivals::NamedRival& rival : rivals::all()) {
      Column& column = comparison.at[t].emplace_back(rival.name);
      for (std::uint64_t seed = 1; seed <= (rival.draws ? seeds : 1); ++seed) {
        const double begin_s = thread_seconds();
        const rivals::RivalPlan plan = rival.plan(rival_problem, {.seconds = times_s[t]}, seed);
        add_plan(column, plan.score, plan.completed_greedily, thread_seconds() - begin_s);
      }
    }
  }
  return comparison;
}

/// Ours is to be at or below the best rival.
void add(const std::string& name, const Comparison& comparison, std::size_t time, double time_s, Sheet& sheet) {
  const std::vector<Column>& columns = comparison.at[time];
  double best_rival_s = std::numeric_limits<double>::infinity();
  for (const Column& column : columns) {
    if (column.planner != kOurs && !column.expected_s.empty()) {
      best_rival_s = std::min(best_rival_s, mean(column.expected_s));
    }
  }
  const std::optional<Target> target =
      best_rival_s < std::numeric_limits<double>::infinity() ? std::optional(Target{best_rival_s}) : std::nullopt;
  for (const Column& column : columns) {
    const bool all_complete = static_cast<int>(column.expected_s.size()) == column.plans;
    if (!all_complete) {
      sheet.add(name, column.planner + ", unseen, worst", 100 * column.worst_unseen, "%",
                Target{100 * comparison.max_unseen_mass});
    } else if (column.planner == kOurs) {
      sheet.add_mean(name, kOurs, column.expected_s, "s", target);
      sheet.add(name, "bound", comparison.bound_s, "s");
    } else if (column.plans > 1) {
      sheet.add_mean(name, column.planner, column.expected_s, "s");
    } else {
      sheet.add(name, column.planner, column.expected_s.front(), "s");
    }
    if (column.completed_greedily > 0) {
      sheet.add(name, column.planner + ", completed greedily", column.completed_greedily,
                "of " + counted(column.plans, "plan"));
    }
    if (column.longest_s > 1.2 * time_s) {
      sheet.add(name, column.planner + ", took", column.longest_s, "s");
    }
  }
}

Result<Scene> m1_uniform(const Options& /*options*/) { return paper_scene(PaperMap::kM1, PaperPrior::kUniform, 3.5); }
Result<Scene> m1_uniform_wide(const Options& /*options*/) {
  return paper_scene(PaperMap::kM1, PaperPrior::kUniform, 5.0);
}
Result<Scene> m1_gaussians(const Options& /*options*/) {
  return paper_scene(PaperMap::kM1, PaperPrior::kGaussians, 3.5);
}
Result<Scene> m1_gaussians_wide(const Options& /*options*/) {
  return paper_scene(PaperMap::kM1, PaperPrior::kGaussians, 5.0);
}
Result<Scene> m2_uniform(const Options& /*options*/) { return paper_scene(PaperMap::kM2, PaperPrior::kUniform, 3.5); }
Result<Scene> courtyard(const Options& /*options*/) { return courtyard_scene(); }
Result<Scene> dubai(const Options& options) { return dubai_scene(options.data, 5.0); }
Result<Scene> sarenv(const Options& options) { return sarenv_scene(options.data); }

}  // namespace

void compare(const Options& options, Sheet& sheet) {
  std::vector<Case> cases = {{"M1/U, 3.5 m", m1_uniform, false},   {"M1/U, 5.0 m", m1_uniform_wide, false},
                             {"M1/G, 3.5 m", m1_gaussians, false}, {"M1/G, 5.0 m", m1_gaussians_wide, false},
                             {"M2/U, 3.5 m", m2_uniform, false},   {"courtyard, 2.5 m", courtyard, false},
                             {"Dubai mask, 5.0 m", dubai, true},   {"SAREnv prior, 3.5 m", sarenv, true}};
  if (options.quick) {
    cases = {cases[1], cases[5], cases[6]};
  }
  const std::vector<double> times_s = options.quick ? std::vector{0.02, 0.05} : std::vector{0.1, 1.0};
  Cores cores;
  std::vector<Comparison> comparisons(cases.size());
  cores.each(cases.size(), "compare", [&](std::size_t i, planner::Planner& planner) {
    comparisons[i] = run(planner, cases[i], options, times_s);
  });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Comparison& comparison = comparisons[i];
    if (!comparison.skipped.empty()) {
      sheet.skip(cases[i].name, comparison.skipped);
      continue;
    }
    for (std::size_t t = 0; t < times_s.size(); ++t) {
      add(cases[i].name + format(", %g s", times_s[t]), comparison, t, times_s[t], sheet);
    }
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (comparisons[i].skipped.empty()) {
      sheet.add(cases[i].name, "nodes", comparisons[i].nodes, "");
      sheet.add(cases[i].name, "graph and tables", comparisons[i].prepare_s, "s");
      sheet.add(cases[i].name, "rivals' bit masks", comparisons[i].coverage_s, "s");
    }
  }
}

}  // namespace ivo::firmware::bench
