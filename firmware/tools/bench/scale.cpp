// How the cost of one generation grows with nodes and agents, and what real maps and priors take.
#include <algorithm>
#include <cmath>
#include <limits>

#include "config/limits.hpp"
#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/trial.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/terminal.hpp"

namespace ivo::firmware::bench {
namespace {

constexpr double kSpacing_m = 3.5;
constexpr double kCell_m = 0.5;

struct Cost {
  double prepare_s = 0.0;
  int nodes = 0;
  std::vector<double> generation_s;  ///< of one core
};

/// Open ground of `side` x `side` squares and `agents` along its lower border.
Scene ground(int side, int agents) {
  Scene scene = open_ground(side * kSpacing_m, side * kSpacing_m, kCell_m, kSpacing_m);
  planner::SearchAgent agent = scene.problem.agents[0];
  scene.problem.agents.clear();
  for (int m = 0; m < agents; ++m) {
    const int column = agents == 1 ? 0 : m * (side - 1) / (agents - 1);
    agent.body.start = {(column + 0.5) * kSpacing_m, 0.5 * kSpacing_m};
    (void)scene.problem.agents.push_back(agent);
  }
  return scene;
}

Result<Cost> cost_of(planner::Planner& planner, const Scene& scene, planner::Profile profile, int generations) {
  constexpr planner::Budget kPart{2'000};
  planner::SearchProblem problem = scene.problem;
  problem.colony.profile = profile;
  problem.colony.rho = profile == planner::Profile::kPaper ? 0.002 : 0.02;
  problem.colony.generations = generations;
  const Result<double> prepared = prepare(planner, problem);
  if (!prepared) {
    return prepared.error();
  }
  Cost cost{.prepare_s = prepared.value(), .nodes = planner.graph().nodes(), .generation_s = {}};
  int generation = 0;
  double begin_s = thread_seconds();
  for (bool done = false; !done;) {
    const planner::Progress progress = planner.step(kPart);
    done = progress.done;
    if (progress.generation > generation) {
      const double now_s = thread_seconds();
      for (int i = generation; i < progress.generation; ++i) {  // several in one part share it
        cost.generation_s.push_back((now_s - begin_s) / (progress.generation - generation));
      }
      generation = progress.generation;
      begin_s = now_s;
    }
  }
  return cost;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

const char* word(planner::Profile profile) { return profile == planner::Profile::kPaper ? "paper" : "fast"; }

void grow(planner::Planner& planner, planner::Profile profile, const Options& options, Sheet& sheet) {
  const std::vector<int> sides = options.quick ? std::vector{10, 16} : std::vector{10, 20, 32, 64, 90, 128};
  const std::string profile_word = word(profile);
  std::vector<std::pair<double, double>> points;  // ln nodes, ln seconds
  for (const int side : sides) {
    const std::string name = profile_word + format(", %d nodes, 2 agents", side * side);
    if (side * side > limits::kNodes) {
      sheet.skip(name,
                 format("more nodes than the %d of this build's %s capacity", limits::kNodes, limits::Planner::kName));
      continue;
    }
    const Result<Cost> cost = cost_of(planner, ground(side, 2), profile, options.quick ? 3 : 8);
    if (!cost) {
      sheet.skip(name, cost.error().message);
      continue;
    }
    points.emplace_back(std::log(cost.value().nodes), std::log(median(cost.value().generation_s)));
    sheet.add_median(name, "one generation", cost.value().generation_s, "s");
    sheet.add(name, "graph and tables", cost.value().prepare_s, "s");
    if (points.size() > 1) {
      const auto& [nodes, seconds] = points[points.size() - 2];
      sheet.add(name, "exponent", (points.back().second - seconds) / (points.back().first - nodes), "");
    }
  }
  if (points.size() > 1) {
    const double exponent =
        (points.back().second - points.front().second) / (points.back().first - points.front().first);
    sheet.add(
        profile_word + format(", %.0f to %.0f nodes", std::exp(points.front().first), std::exp(points.back().first)),
        "exponent", exponent, "", options.quick ? std::nullopt : std::optional(Target{1.2}));
  }
}

void add_agents(planner::Planner& planner, const Options& options, Sheet& sheet) {
  const int side = options.quick ? 10 : 32;
  for (const int agents : {1, 2, 4, 8}) {
    const std::string name = format("fast, %d nodes, ", side * side) + counted(agents, "agent");
    if (agents > limits::kAgents) {
      sheet.skip(
          name, format("more agents than the %d of this build's %s capacity", limits::kAgents, limits::Planner::kName));
      continue;
    }
    const Result<Cost> cost = cost_of(planner, ground(side, agents), planner::Profile::kFast, options.quick ? 3 : 8);
    if (!cost) {
      sheet.skip(name, cost.error().message);
      continue;
    }
    sheet.add_median(name, "one generation", cost.value().generation_s, "s");
    sheet.add(name, "graph and tables", cost.value().prepare_s, "s");
  }
}

/// A complete plan within a second of search, and how good the plan of that second is.
void add_real(planner::Planner& planner, const std::string& name, const Result<Scene>& scene, const Options& options,
              Sheet& sheet) {
  constexpr planner::Budget kPart{5'000};
  constexpr double kLimit_s = 1.0;
  const double longest_s = options.quick ? kLimit_s : 20.0;
  if (!scene) {
    sheet.skip(name, scene.error().message);
    return;
  }
  planner::SearchProblem problem = scene.value().problem;
  problem.colony.profile = planner::Profile::kFast;
  problem.colony.rho = 0.02;
  problem.colony.generations = std::numeric_limits<int>::max();
  const Result<double> prepared = prepare(planner, problem);
  if (!prepared) {
    sheet.skip(name, prepared.error().message);
    return;
  }
  planner::Progress progress;
  const double begin_s = thread_seconds();
  double complete_s = std::numeric_limits<double>::infinity();
  double now_s = 0.0;
  for (bool more = true; more;
       more = !progress.done && (now_s < kLimit_s || (complete_s > now_s && now_s < longest_s))) {
    progress = planner.step(kPart);
    now_s = thread_seconds() - begin_s;
    complete_s = progress.has_plan && progress.best.complete ? std::min(complete_s, now_s) : complete_s;
  }
  const bool complete = complete_s <= longest_s;
  sheet.add(name, "nodes", planner.graph().nodes(), "");
  sheet.add(name, "graph and tables", prepared.value(), "s");
  sheet.add(name, complete ? "complete plan after" : "no complete plan within", complete ? complete_s : longest_s, "s",
            Target{complete ? kLimit_s : 0.0});
  sheet.add(name, "searched", now_s, "s");
  if (!progress.has_plan) {
    return;
  }
  const double bound_s = planner.bounds(progress.best.unseen_mass).bound_s();
  sheet.add(name, "ET_c", progress.best.expected_time_continuous_s, "s");
  sheet.add(name, "unseen", 100 * progress.best.unseen_mass, "%");
  sheet.add(name, "bound", bound_s, "s");
  if (bound_s > 0.0) {
    sheet.add(name, "gap", 100 * (progress.best.expected_time_continuous_s / bound_s - 1), "%");
  }
}

}  // namespace

void scale(const Options& options, Sheet& sheet) {
  const auto planner = make_planner();
  grow(*planner, planner::Profile::kPaper, options, sheet);
  grow(*planner, planner::Profile::kFast, options, sheet);
  add_agents(*planner, options, sheet);
  for (const char* name : {"Dubai mask, 5 m", "Dubai mask, 3.5 m", "SAREnv prior, 3.5 m"}) {
    if (options.data.empty()) {
      sheet.skip(name, "no --data folder");
    }
  }
  if (!options.data.empty()) {
    add_real(*planner, "Dubai mask, 5 m", dubai_scene(options.data, 5.0), options, sheet);
    add_real(*planner, "Dubai mask, 3.5 m", dubai_scene(options.data, 3.5), options, sheet);
    add_real(*planner, "SAREnv prior, 3.5 m", sarenv_scene(options.data), options, sheet);
  }
}

}  // namespace ivo::firmware::bench
