// `ivo dbc`: a robot's bus, described for other tools.
#pragma once

#include <string>

namespace ivo::firmware {

struct DbcOptions {
  std::string robot;
  std::string out;  ///< file; empty: standard output
};

/// Returns the exit status: 0, 1 when it could not be written, 2 for wrong input.
[[nodiscard]] int dbc(const DbcOptions& options);

}  // namespace ivo::firmware
