// System calls of a piece of work, as the kernel sees them.
#pragma once

#include <functional>
#include <vector>

#include "config/base/result.hpp"

namespace ivo::firmware::bench {

/// The numbers (sys/syscall.h) of the calls of `work`, done in a child process under ptrace. What it changes is the
/// child's alone, save for what sockets and files share. After it come the child's own last call or calls. An error
/// where nobody may trace.
[[nodiscard]] Result<std::vector<long>> system_calls_of(const std::function<void()>& work);

}  // namespace ivo::firmware::bench
