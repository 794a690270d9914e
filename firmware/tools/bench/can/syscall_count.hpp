// System calls of a piece of work, as the kernel sees them.
#pragma once

#include <functional>

#include "config/base/result.hpp"

namespace ivo::firmware::bench {

/// Does `work` in a child process under ptrace and counts, and takes off what a child without work calls. What it
/// changes is the child's alone, save for what sockets and files share. An error where nobody may trace.
[[nodiscard]] Result<int> count_system_calls(const std::function<void()>& work);

}  // namespace ivo::firmware::bench
