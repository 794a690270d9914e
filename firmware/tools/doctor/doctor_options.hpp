// What `ivo doctor` was asked on the command line.
#pragma once

#include <optional>
#include <string>

namespace ivo::firmware::doctor {

struct Options {
  std::string robot;                ///< file; empty: the built-in IVO-class base
  std::string can;                  ///< interface; empty: bus and drives are not checked
  std::string out = "out";          ///< folder where results will go
  std::string json;                 ///< file for the findings; empty: none
  std::optional<int> cpu;           ///< that is to be looked at; none: the robot file's, which the loop binds itself to
  std::optional<int> priority;      ///< of the loop's thread; none: the robot file's
  std::optional<double> latency_s;  ///< how long wake-ups are measured; 0: not at all; none: kLatencyS
};
inline constexpr double kLatencyS = 5.0;

/// The whole of `ivo doctor`. Exit status: 0 no fault, 1 a fault or a stop, 2 wrong input.
[[nodiscard]] int examine(const Options& options);

}  // namespace ivo::firmware::doctor
