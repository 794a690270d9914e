// How good the fast profile's plans are after 0.1, 1 and 10 s of search on one core, beside the bound. A plan counts
// only when it is complete; means of 10 seeds.
#include <limits>
#include <numeric>

#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/trial.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr double kSecond = 1.0;  // the time for which there is a target

struct QualityCase {
  PaperPrior prior;
  double spacing_m;
  double target_s;
};

/// The best plan at each of the times; search times are of one core.
struct Run {
  Result<double> prepared = Error{};
  std::vector<planner::PlanScore> at;
  std::vector<double> bound_s;
};

Run run(planner::Planner& planner, const planner::SearchProblem& problem, const std::vector<double>& times_s) {
  constexpr planner::Budget kPart{5'000};
  Run run;
  run.prepared = prepare(planner, problem);
  if (!run.prepared) {
    return run;
  }
  const double begin_s = thread_seconds();
  for (const double time_s : times_s) {
    while (thread_seconds() - begin_s < time_s && !planner.step(kPart).done) {
    }
    const planner::Progress progress = planner.progress();
    run.at.push_back(progress.has_plan ? progress.best : planner::PlanScore{});
    run.bound_s.push_back(planner.bounds(run.at.back().unseen_mass).bound_s());
  }
  return run;
}

void add_time(const std::string& name, const std::vector<Run>& runs, std::size_t time, std::optional<Target> target,
              Sheet& sheet) {
  std::vector<double> expected_s;
  std::vector<double> bound_s;
  std::vector<double> gap;
  for (const Run& run : runs) {
    const planner::PlanScore& score = run.at[time];
    if (score.complete) {
      expected_s.push_back(score.expected_time_continuous_s);
      bound_s.push_back(run.bound_s[time]);
      if (run.bound_s[time] > 0.0) {
        gap.push_back(100 * (expected_s.back() / run.bound_s[time] - 1));
      }
    }
  }
  sheet.add(name, "complete", static_cast<double>(expected_s.size()), "seeds",
            target ? std::optional(Target{static_cast<double>(runs.size()), Sense::kAtLeast}) : std::nullopt);
  if (!expected_s.empty()) {
    // The mean of fewer seeds than there are would flatter.
    const bool all = expected_s.size() == runs.size();
    sheet.add_mean(name, "ET_c", expected_s, "s", all ? target : std::nullopt);
    sheet.add(name, "bound", std::accumulate(bound_s.begin(), bound_s.end(), 0.0) / static_cast<double>(bound_s.size()),
              "s");
    if (gap.size() == bound_s.size()) {
      sheet.add_mean(name, "gap", gap, "%");
    }
  }
  std::vector<double> prepare_s;
  prepare_s.reserve(runs.size());
  for (const Run& run : runs) {
    prepare_s.push_back(run.prepared.value());
  }
  sheet.add_median(name, "graph and tables", prepare_s, "s");
}

}  // namespace

void quality(const Options& options, Sheet& sheet) {
  const QualityCase cases[] = {
      {PaperPrior::kUniform, 5.0, 77.3}, {PaperPrior::kUniform, 3.5, 83.8}, {PaperPrior::kGaussians, 3.5, 36.8}};
  const std::vector<double> times_s = options.quick ? std::vector{0.05, 0.2} : std::vector{0.1, kSecond, 10.0};
  const std::size_t seeds = options.quick ? 2 : 10;
  Cores cores;
  for (const QualityCase& c : cases) {
    std::vector<Run> runs(seeds);
    cores.each(seeds, "quality", [&](std::size_t i, planner::Planner& planner) {
      const Result<Scene> scene = paper_scene(PaperMap::kM1, c.prior, c.spacing_m);
      planner::SearchProblem problem = scene.value().problem;
      problem.colony.profile = planner::Profile::kFast;
      problem.colony.rho = 0.02;
      problem.colony.generations = std::numeric_limits<int>::max();
      problem.colony.seed = 1 + i;
      runs[i] = run(planner, problem, times_s);
    });
    const std::string name =
        paper_scene(PaperMap::kM1, c.prior, c.spacing_m).value().name + format(", %.1f m", c.spacing_m);
    if (!runs.front().prepared) {
      sheet.skip(name, runs.front().prepared.error().message);
      continue;
    }
    for (std::size_t t = 0; t < times_s.size(); ++t) {
      const std::optional<Target> target = times_s[t] == kSecond ? std::optional(Target{c.target_s}) : std::nullopt;
      add_time(name + format(", %g s", times_s[t]), runs, t, target, sheet);
    }
  }
}

}  // namespace ivo::firmware::bench
