// table_one GENERATIONS TRIALS: the rows of Table I with eta_TSP on this build's arithmetic, a line each: mean ET, its
// standard error, the mean unseen mass. table_one_test.py compares two builds.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "planner/search/planner.hpp"
#include "tests/support/drawn_map.hpp"

namespace ivo {
namespace {

using enum SemanticClass;

// As toolchain/maps/m2.py draws it.
void draw_m2(test::DrawnMap& map) {
  map.put(kBuilding, 5, 26, 13, 34).put(kPavement, 9, 26, 13, 29).put(kBuilding, 24, 29, 34, 35);
  map.put(kBuilding, 27, 10, 35, 16).put(kPavement, 27, 10, 30, 12).put(kBuilding, 7, 7, 12, 13);
  map.put(kWall, 16, 16, 16.5, 24).put(kWall, 16, 16, 20, 16.5).put(kWall, 23.5, 16, 24, 21);
  map.put(kWall, 19.5, 23.5, 24, 24).put(kWall, 4, 19, 11, 19.5).put(kWall, 17.5, 4, 18, 11);
  map.put(kWall, 22, 5.5, 30, 6).put(kWall, 29, 21, 36, 21.5).put(kWall, 28.75, 21, 29.25, 25);
  map.put(kWall, 17.5, 29, 18, 36);
}

int run(int generations, int trials) {
  static planner::Planner planner;
  const std::vector<planner::GaussianComponent> gaussians = {{{12.0, 12.0}, 4.0, 1.0}, {{30.0, 28.0}, 4.0, 1.0}};
  const std::array<std::int8_t, 2> nearest = {0, 1};
  for (const bool m2 : {false, true}) {
    test::DrawnMap map(40.0, 40.0, 0.25);
    if (m2) {
      draw_m2(map);
    }
    for (const bool peaked : {false, true}) {
      for (const bool sub_priors : {false, true}) {
        double sum = 0.0;
        double squares = 0.0;
        double unseen = 0.0;
        for (int trial = 1; trial <= trials; ++trial) {
          planner::SearchProblem problem;
          problem.map = map.view();
          problem.agents.resize(2);
          problem.agents[0].body.start = {1.75, 1.75};
          problem.agents[1].body.start = {39.25, 1.75};
          problem.agents[0].speed_mps = problem.agents[1].speed_mps = 1.0;
          if (peaked) {
            problem.prior = std::span<const planner::GaussianComponent>(gaussians);
          }
          if (sub_priors && peaked) {
            problem.sub_priors = planner::DealtComponents{nearest};
          } else if (sub_priors) {
            problem.sub_priors = planner::AlikeSubPriors{};
          }
          problem.colony.profile = planner::Profile::kPaper;
          problem.colony.generations = generations;
          problem.colony.seed = static_cast<std::uint64_t>(trial);
          if (const planner::Refusal refusal = planner.prepare(problem)) {
            std::fprintf(stderr, "table_one: refused with code %d\n", static_cast<int>(refusal.code));
            return 1;
          }
          while (!planner.step({1'000'000}).done) {
          }
          const planner::PlanScore score = planner.progress().best;
          sum += score.expected_time_s;
          squares += score.expected_time_s * score.expected_time_s;
          unseen += score.unseen_mass;
        }
        const double mean = sum / trials;
        const double variance = (squares - sum * mean) / (trials - 1);
        std::printf("%s/%s%s %.4f %.4f %.5f\n", m2 ? "M2" : "M1", peaked ? "G" : "U", sub_priors ? "/S" : "", mean,
                    std::sqrt(variance / trials), unseen / trials);
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace ivo

int main(int argc, char** argv) {
  const int generations = argc > 1 ? std::atoi(argv[1]) : 0;
  const int trials = argc > 2 ? std::atoi(argv[2]) : 0;
  if (argc != 3 || generations < 1 || trials < 2) {
    std::fprintf(stderr, "table_one: expected GENERATIONS (at least 1) and TRIALS (at least 2)\n");
    return 2;
  }
  return ivo::run(generations, trials);
}
