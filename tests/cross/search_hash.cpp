// Plans the cases, each in several slicings, and prints what came of them, bit for bit: one line a case, and one hash.
// Every CPU must print the same. Exit status 1 when a search is refused or its slicing shows.
#include <bit>
#include <cstdint>
#include <optional>

#include "tests/cross/line.hpp"
#include "tests/cross/search_cases.hpp"

namespace ivo::cross {
namespace {

planner::Planner planner_under_test;
planner::SearchProblem problem;
planner::Plan plan;

// FNV-1a, 64 bits.
class Hash {
 public:
  void add(std::uint64_t word) noexcept {
    for (int i = 0; i < 8; ++i) {
      value_ = (value_ ^ (word & 0xFFU)) * 0x100000001B3ULL;
      word >>= 8U;
    }
  }
  void add(double number) noexcept { add(std::bit_cast<std::uint64_t>(number)); }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

std::uint64_t hash_of_plan() noexcept {
  Hash hash;
  for (const planner::AgentPath& path : plan.paths) {
    hash.add(std::uint64_t{path.waypoints.size()});
    for (const Point p : path.waypoints) {
      hash.add(p.x_m);
      hash.add(p.y_m);
    }
    hash.add(path.length_m);
    hash.add(path.duration_s);
  }
  const planner::PlanScore& score = plan.score;
  for (const double number : {score.expected_time_s, score.expected_time_continuous_s, score.expected_sub_prior_time_s,
                              score.unseen_mass, score.horizon_s}) {
    hash.add(number);
  }
  hash.add(std::uint64_t{score.complete ? 1U : 0U});
  return hash.value();
}

// How a graph comes to the planner must not show in the plan either; only a hosted CPU can build one.
enum class GraphFrom { kTable, kMap };

std::optional<std::uint64_t> search(int number, int units, GraphFrom from) noexcept {
  describe_case(number, problem);
  const planner::GraphTable table = graph_table(number);
  problem.graph_table = from == GraphFrom::kTable ? &table : nullptr;
  if (const planner::Refusal refusal = planner_under_test.prepare(problem)) {
    Line().text(case_name(number)).text(": refused with code ").whole(static_cast<int>(refusal.code));
    return std::nullopt;
  }
  while (!planner_under_test.step({units}).done) {
  }
  planner_under_test.best_plan(plan);
  return hash_of_plan();
}

std::int64_t thousandths(double number) noexcept { return static_cast<std::int64_t>(number * 1000.0 + 0.5); }

struct Slicing {
  int units;
  GraphFrom from;
};
constexpr Slicing kSlicings[] = {{1009, GraphFrom::kTable},
                                 {1, GraphFrom::kTable},
#if IVO_LIBCCD
                                 {1'000'000'000, GraphFrom::kMap}
#endif
};

}  // namespace

int run() noexcept {
  Hash all;
  for (int number = 0; number < kCases; ++number) {
    std::optional<std::uint64_t> expected;
    for (const Slicing& slicing : kSlicings) {
      const std::optional<std::uint64_t> hash = search(number, slicing.units, slicing.from);
      if (!hash) {
        return 1;
      }
      if (expected && *hash != *expected) {
        Line().text(case_name(number)).text(": another plan in slices of ").whole(slicing.units).text(" units");
        return 1;
      }
      expected = hash;
    }
    Line()
        .text(case_name(number))
        .text(": ")
        .whole(planner_under_test.graph().nodes())
        .text(" nodes, ET ")
        .decimal(thousandths(plan.score.expected_time_s))
        .text(" s, unseen ")
        .decimal(thousandths(plan.score.unseen_mass * 100.0))
        .text(" %, plan ")
        .hex(*expected);
    all.add(*expected);
  }
  Line().text("hash ").hex(all.value());
  return 0;
}

}  // namespace ivo::cross
