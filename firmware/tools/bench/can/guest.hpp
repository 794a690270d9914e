// This bench once more, where there is a bus that nobody else uses: in toolchain/vcan.
#pragma once

#include <vector>

#include "config/base/result.hpp"
#include "firmware/tools/bench/bench.hpp"

namespace ivo::firmware::bench {

/// Whether the interfaces here are this program's own to break: inside toolchain/vcan.
[[nodiscard]] bool owns_network();

/// Runs `ivo bench can` in toolchain/vcan, which is looked for in the folders above this program, and returns its
/// records. An error, in one line, when it cannot be started or fails.
[[nodiscard]] Result<std::vector<Record>> records_from_guest(const Options& options);

}  // namespace ivo::firmware::bench
