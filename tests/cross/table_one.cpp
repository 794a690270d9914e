// table_one GENERATIONS TRIALS: the rows of Table I with eta_TSP on this build's arithmetic, a line each: mean ET, its
// standard error, the mean unseen mass. table_one_test.py compares two builds.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/cross/paper_case.hpp"

namespace ivo {
namespace {

int run(int generations, int trials) {
  static planner::Planner planner;
  for (const bool m2 : {false, true}) {
    for (const bool peaked : {false, true}) {
      for (const bool sub_priors : {false, true}) {
        const cross::PaperRow row{.m2 = m2, .peaked = peaked, .sub_priors = sub_priors};
        double sum = 0.0;
        double squares = 0.0;
        double unseen = 0.0;
        for (int trial = 1; trial <= trials; ++trial) {
          cross::PaperCase paper(row);
          planner::SearchProblem& problem = paper.problem();
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
        std::printf("%s %.4f %.4f %.5f\n", cross::name_of(row).c_str(), mean, std::sqrt(variance / trials),
                    unseen / trials);
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
