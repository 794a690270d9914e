// How many instructions the planner's slices take, by kind of slice: none may be longer than 1.2 times the median of
// its kind. Exit status 1 when one is.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "tests/cross/line.hpp"
#include "tests/cross/search_cases.hpp"

namespace ivo::cross {
namespace {

constexpr int kUnits = 10'000;  // of a slice: a tenth of what the loop gives to a cycle
constexpr std::int64_t kMostPercentOfMedian = 120;
constexpr int kKinds = 16;

planner::Planner planner_under_test;
planner::SearchProblem problem;

struct Slice {
  std::uint32_t kind : 4;
  std::uint32_t instructions : 28;
};
std::array<Slice, 300'000> slices;
std::size_t slice_count = 0;
std::array<std::uint32_t, 300'000> of_one_kind;

std::uint32_t instructions_between(unsigned begin, unsigned end) noexcept {
  const InstructionsPerTick rate = instructions_per_tick();
  return static_cast<std::uint32_t>(std::uint64_t{end - begin} * rate.instructions / rate.ticks);
}

// The clock's own share, taken off every slice.
std::uint32_t instructions_of_nothing() noexcept {
  (void)instruction_clock();  // the first starts it
  const unsigned begin = instruction_clock();
  return instructions_between(begin, instruction_clock());
}

void loop(unsigned turns) noexcept {
  asm volatile(
      "0: subs %0, %0, #1\n"
      "   bne 0b\n"
      : "+l"(turns)
      :
      : "cc");
}
std::uint32_t instructions_of_loop(unsigned turns) noexcept {
  const unsigned begin = instruction_clock();
  loop(turns);
  return instructions_between(begin, instruction_clock());
}

// A turn is two instructions. A machine whose clock follows something else would judge by chance.
bool clock_counts_instructions() noexcept {
  (void)instruction_clock();
  constexpr std::uint32_t kFew = 10;
  constexpr std::uint32_t kMany = 12'345;
  const std::uint32_t counted = instructions_of_loop(kMany) - instructions_of_loop(kFew);
  constexpr std::uint32_t kExpected = 2 * (kMany - kFew);
  constexpr std::uint32_t kRounding = 2;
  Line().text("clock: a loop of ").whole(kExpected).text(" instructions counts as ").whole(counted);
  return counted + kRounding >= kExpected && counted <= kExpected + kRounding;
}

void measure() noexcept {
  const std::uint32_t nothing = instructions_of_nothing();
  slice_count = 0;
  for (bool done = false; !done && slice_count < slices.size();) {
    const unsigned begin = instruction_clock();
    done = planner_under_test.step({kUnits}).done;
    const unsigned end = instruction_clock();
    if (planner_under_test.last_slice_was_full()) {
      slices[slice_count++] = {.kind = static_cast<std::uint32_t>(planner_under_test.last_slice_kind()) % kKinds,
                               .instructions = (instructions_between(begin, end) - nothing) & 0xFFF'FFFFU};
    }
  }
}

// False when a slice is too long.
bool report(int number, std::uint32_t kind) noexcept {
  std::size_t count = 0;
  for (const Slice& slice : std::span(slices).first(slice_count)) {
    if (slice.kind == kind) {
      of_one_kind[count++] = slice.instructions;
    }
  }
  if (count == 0) {
    return true;
  }
  const auto begin = of_one_kind.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(count);
  const auto middle = begin + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(begin, middle, end);
  const std::int64_t median = std::max<std::uint32_t>(*middle, 1);
  const std::int64_t longest = *std::max_element(begin, end);
  const bool holds = longest * 100 <= median * kMostPercentOfMedian;
  Line()
      .text(case_name(number))
      .text(", kind ")
      .whole(kind)
      .text(": ")
      .whole(static_cast<std::int64_t>(count))
      .text(" slices, median ")
      .whole(median)
      .text(", longest ")
      .whole(longest)
      .text(" instructions, ratio ")
      .decimal(longest * 1000 / median)
      .text(", ")
      .decimal(median * 1000 / kUnits)
      .text(" a unit")
      .text(holds ? "" : "  TOO LONG");
  return holds;
}

}  // namespace

int run() noexcept {
  if (!clock_counts_instructions()) {
    return 1;
  }
  bool holds = true;
  for (int number = 0; number < kCases; ++number) {
    describe_case(number, problem);
    const planner::GraphTable table = graph_table(number);
    problem.graph_table = &table;
    if (planner_under_test.prepare(problem)) {
      Line().text(case_name(number)).text(": refused");
      return 1;
    }
    measure();
    for (std::uint32_t kind = 0; kind < kKinds; ++kind) {
      holds = report(number, kind) && holds;
    }
  }
  return holds ? 0 : 1;
}

}  // namespace ivo::cross
