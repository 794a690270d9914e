// `ivo console`: asks a controller that runs, or tells it something, where it has no terminal.
#pragma once

#include <string>

namespace ivo::firmware {

enum class ConsoleVerb { kStatus, kConsent, kRefuse, kStop, kClear };

struct ConsoleOptions {
  ConsoleVerb verb = ConsoleVerb::kStatus;
  std::string socket = "/run/ivo/console.sock";  ///< the service's
};

/// Returns the exit status: 0, 1 when the controller refuses, 2 when there is none.
[[nodiscard]] int console_command(const ConsoleOptions& options);

}  // namespace ivo::firmware
