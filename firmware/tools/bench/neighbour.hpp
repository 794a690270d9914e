// Other programs: what a bench measures the product against is not part of it and lies in this program's folder.
#pragma once

#include <string>
#include <vector>

#include "config/base/result.hpp"

namespace ivo::firmware::bench {

/// Runs `name` from this program's folder to its end, without standard input, and returns what it wrote to standard
/// output. An error, in one line, when it is not there or does not end with 0. It ends with this program, however that
/// ends. Called from the thread that lives as long as the program. Cost: the program's.
[[nodiscard]] Result<std::string> output_of_neighbour(const std::string& name, const std::vector<std::string>& args);

/// The same of any program; `path` is absolute. `last_signal` is what it gets when this program ends first.
[[nodiscard]] Result<std::string> output_of(const std::string& path, const std::vector<std::string>& args,
                                            int last_signal);

}  // namespace ivo::firmware::bench
