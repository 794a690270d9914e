// Foreign programs that provoke faults: can-utils and iproute2.
#pragma once

#include <string>
#include <vector>

#include "config/base/result.hpp"

namespace ivo::firmware::bench {

/// Runs `words` to its end, found in PATH, /usr/sbin or /sbin, without input; what it writes is thrown away. An error,
/// in one line, when it is not there or does not end with 0.
[[nodiscard]] Result<void> run_tool(const std::vector<std::string>& words);

}  // namespace ivo::firmware::bench
