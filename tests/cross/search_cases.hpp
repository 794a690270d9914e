// The searches that every CPU must plan alike. Sized for the micro profile, and to take seconds on an emulated CPU.
#pragma once

#include <string_view>

#include "planner/search/planner.hpp"
#include "planner/world/graph_table.hpp"

namespace ivo::cross {

inline constexpr int kCases = 6;

[[nodiscard]] std::string_view case_name(int number) noexcept;

/// Fills in the problem, without a graph table. Its map and prior are valid until the next call.
void describe_case(int number, planner::SearchProblem& problem) noexcept;

/// The case's graph as the host built it: in the source that graph_tables_main.cpp writes.
[[nodiscard]] planner::GraphTable graph_table(int number) noexcept;

}  // namespace ivo::cross
