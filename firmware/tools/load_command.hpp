// `ivo load`: how full a robot's bus is, as computed, and in a record of frames.
#pragma once

#include <string>

namespace ivo::firmware {

struct LoadOptions {
  std::string robot;
  std::string log;  ///< as candump -L writes it; empty: none
};

/// Returns the exit status: 0, or 2 for wrong input.
[[nodiscard]] int load(const LoadOptions& options);

}  // namespace ivo::firmware
