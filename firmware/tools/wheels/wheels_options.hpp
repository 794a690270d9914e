// What `ivo wheels` was asked on the command line.
#pragma once

#include <optional>
#include <string>

namespace ivo::firmware::wheels {

struct Options {
  std::string can;                ///< interface; empty: `simulated`
  bool simulated = false;         ///< four simulated drives in this process
  std::string robot;              ///< file; empty: the built-in IVO-class base
  std::string simulated_robot;    ///< file that the simulated drives are made by; empty: as `robot`
  std::string wheel;              ///< of turn
  std::optional<double> radps;    ///< of turn and check
  std::optional<double> turns;    ///< of check, a wheel
  std::optional<double> seconds;  ///< of watch; without it until it is stopped
};

inline constexpr double kUsualRadps = 0.5;  ///< of turn and check

// Each returns the exit status: 0 all is well, 1 something is not, or a fault, or a stop; 2 wrong input, nothing was
// sent.
[[nodiscard]] int list(const Options& options);
[[nodiscard]] int watch(const Options& options);
[[nodiscard]] int turn(const Options& options);
[[nodiscard]] int check(const Options& options);

}  // namespace ivo::firmware::wheels
