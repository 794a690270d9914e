// `ivo bench`: runs benches, shows their figures, writes them for programs.
#pragma once

#include <string>

#include "firmware/tools/bench/bench.hpp"

namespace ivo::firmware::bench {

struct CommandOptions {
  std::string name;  ///< a bench, "all", or empty: a list of them
  std::string json;  ///< file for the records; empty: none
  Options bench;
};

/// The whole of `ivo bench`. Returns the exit status: 0 when all ran, whether their targets hold or not; 1 not written,
/// 2 wrong input.
[[nodiscard]] int run(const CommandOptions& options);

}  // namespace ivo::firmware::bench
