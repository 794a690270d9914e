// ivo-console from its options on.
#pragma once

#include <atomic>
#include <ostream>

#include "config/base/result.hpp"
#include "firmware/web/console_options.hpp"

namespace ivo::firmware::web {

/// Serves until `stop` is set, and says on `out` what happens, a line an event; or prints a new token. Fails with why
/// it cannot begin.
[[nodiscard]] Result<void> run_console(const ConsoleOptions& options, const std::atomic<bool>& stop, std::ostream& out);

}  // namespace ivo::firmware::web
