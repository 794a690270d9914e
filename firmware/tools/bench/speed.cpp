// How fast the paper's search is: 400 generations of 10 ants, 3.5 m spacing, 0.25 m cells, one core, tables apart.
#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/trial.hpp"

namespace ivo::firmware::bench {
namespace {

struct Case {
  PaperMap map = PaperMap::kM1;
  double published_s = 0.0;  ///< Gil and Sanfeliu, RA-L 2024, Table I, TSP
  std::optional<Target> target;
};

}  // namespace

void speed(const Options& options, Sheet& sheet) {
  const auto planner = std::make_unique<planner::Planner>();
  const Case cases[] = {{PaperMap::kM1, 44.0, Target{0.25}}, {PaperMap::kM2, 116.0, std::nullopt}};
  const int runs = options.quick ? 2 : 9;
  for (const Case& c : cases) {
    Result<Scene> scene = paper_scene(c.map, PaperPrior::kUniform, 3.5);
    if (!scene) {
      sheet.skip("M2/U", scene.error().message);
      continue;
    }
    planner::ColonyParameters& colony = scene.value().problem.colony;
    colony.profile = planner::Profile::kPaper;
    colony.rho = 0.002;
    colony.generations = options.quick ? 5 : 400;
    colony.ants = 10;
    std::vector<double> search_s;
    std::vector<double> prepare_s;
    std::vector<double> ratio;
    for (int run = 0; run < runs; ++run) {
      const Result<Found> found = search_to_end(*planner, scene.value().problem);
      if (!found) {
        sheet.skip(scene.value().name, found.error().message);
        break;
      }
      search_s.push_back(found.value().search_s);
      prepare_s.push_back(found.value().prepare_s);
      ratio.push_back(c.published_s / found.value().search_s);
    }
    if (!search_s.empty()) {
      const std::string name = scene.value().name;
      sheet.add_median(name, "search", search_s, "s", options.quick ? std::nullopt : c.target);
      sheet.add(name, "paper's", c.published_s, "s");
      sheet.add_median(name, "times as fast as the paper", ratio, "", std::nullopt, Sense::kAtLeast);
      sheet.add_median(name, "graph and tables", prepare_s, "s");
    }
  }
}

}  // namespace ivo::firmware::bench
