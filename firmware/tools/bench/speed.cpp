// How fast the paper's search is: 400 generations of 10 ants, 3.5 m spacing, 0.25 m cells, one core, tables apart; and
// how many times as fast as a planner without tables that takes the same decisions. That one is no part of the product:
// ivo-naive, a program of the tests, where it has been built.
#include <algorithm>
#include <array>
#include <string>

#include "firmware/files/json_value.hpp"
#include "firmware/tools/bench/bench.hpp"
#include "firmware/tools/bench/neighbour.hpp"
#include "firmware/tools/bench/trial.hpp"
#include "firmware/tools/planner_object.hpp"

namespace ivo::firmware::bench {
namespace {

struct SpeedCase {
  PaperMap map = PaperMap::kM1;
  const char* word = "";     ///< as ivo-naive calls the map
  double published_s = 0.0;  ///< Gil and Sanfeliu, RA-L 2024, Table I, TSP
  double target_s = 0.0;
};

// M1: asked for. M2: the same share of what the paper reports, 116 s x 0.25 / 44.
constexpr std::array<SpeedCase, 2> kSpeedCases = {
    {{PaperMap::kM1, "m1", 44.0, 0.25}, {PaperMap::kM2, "m2", 116.0, 0.66}}};

const Json* record_of(const Json& list, const std::string& figure) {
  const auto found = std::find_if(list.elements.begin(), list.elements.end(), [&](const Json& record) {
    const Json* const name = record.member("figure");
    const Json* const value = record.member("value");
    return name != nullptr && name->text == figure && value != nullptr && value->is_number();
  });
  return found == list.elements.end() ? nullptr : &*found;
}

/// Both planners measured by ivo-naive in one run.
void add_naive(const SpeedCase& c, const std::string& scene, bool quick, Sheet& sheet) {
  const std::string name = scene + ", beside the naive planner";
  const Result<std::string> text =
      output_of_neighbour("ivo-naive", {"--map", c.word, "--generations", quick ? "1" : "4", "--json", "-"});
  if (!text) {
    sheet.skip(name, text.error().message);
    return;
  }
  const Result<Json> list = parse_json(text.value(), "ivo-naive", "its records");
  const Json* const naive = list ? record_of(list.value(), "naive planner, an ant") : nullptr;
  const Json* const median = list ? record_of(list.value(), "times as fast") : nullptr;
  const Json* const worst = list ? record_of(list.value(), "times as fast, worst") : nullptr;
  if (naive == nullptr || median == nullptr || worst == nullptr) {
    sheet.skip(name, "ivo-naive did not say how fast it is");
    return;
  }
  sheet.add(name, "naive planner, an ant", naive->member("value")->real, "us");
  sheet.add(name, "times as fast as the naive planner", median->member("value")->real, "",
            quick ? std::nullopt : std::optional(Target{100.0, Sense::kAtLeast}));
  sheet.add(name, "times as fast as the naive planner, worst", worst->member("value")->real, "");
}

}  // namespace

void speed(const Options& options, Sheet& sheet) {
  const auto planner = make_planner();
  const int runs = options.quick ? 2 : 9;
  for (const SpeedCase& c : kSpeedCases) {
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
      sheet.add_median(name, "search", search_s, "s", options.quick ? std::nullopt : std::optional(Target{c.target_s}));
      sheet.add(name, "paper's", c.published_s, "s");
      sheet.add_median(name, "times as fast as the paper", ratio, "", std::nullopt, Sense::kAtLeast);
      sheet.add_median(name, "graph and tables", prepare_s, "s");
      add_naive(c, name, options.quick, sheet);
    }
  }
}

}  // namespace ivo::firmware::bench
