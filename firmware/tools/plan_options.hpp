// What `ivo plan` and `ivo score` were asked on the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "config/mission.hpp"

namespace ivo::firmware {

/// What is not given is as the mission has it.
struct PlanOptions {
  std::string mission;
  std::string out;  ///< folder; empty: out/<mission's file name>
  std::optional<SearchProfile> profile;
  std::optional<SearchHeuristic> heuristic;
  std::optional<double> time_limit_s;  ///< of search, after graph and tables; alone it lifts the mission's generations
  std::optional<int> iterations;       ///< generations
  std::optional<std::uint64_t> seed;
  int threads = 1;
};

struct ScoreOptions {
  std::string mission;
  std::string plan;
  std::string json;  ///< file for the score; empty: none
  std::string out;   ///< folder for score.json and the picture; empty: none
};

/// The whole of `ivo plan`. Returns the exit status: 0 searched to the end, 1 stopped or not written, 2 wrong input.
[[nodiscard]] int plan(const PlanOptions& options);

/// The whole of `ivo score`. Returns the exit status: 0 scored, 1 not written, 2 wrong input.
[[nodiscard]] int score(const ScoreOptions& options);

}  // namespace ivo::firmware
